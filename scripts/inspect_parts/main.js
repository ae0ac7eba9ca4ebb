// Starts the page on the data that it carries.

import {Inspector} from "./inspector.js";
import {inflated} from "./pack.js";

inflated(document.getElementById("data").textContent.trim()).then(data => {
  document.body.inspector = new Inspector(document, data);
  document.body.dataset.ready = "yes";
});
