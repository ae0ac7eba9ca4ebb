// Shows the data that the page carries.

import {Inspector} from "./inspector.js";
import {inflated} from "./pack.js";

const MANY = 10000;  // triangles, which take a while

// Waits until the browser has painted.
const painted = () => new Promise(resolve => {
  requestAnimationFrame(() => setTimeout(resolve));
  setTimeout(resolve, 100);
});

inflated(document.getElementById("data").textContent.trim()).then(async data => {
  if (data.triangles > MANY) {
    document.getElementById("title").textContent = `reading ${data.triangles.toLocaleString("en")} triangles`;
    await painted();
  }
  document.body.inspector = new Inspector(document, data);
  document.body.dataset.ready = "yes";
});
