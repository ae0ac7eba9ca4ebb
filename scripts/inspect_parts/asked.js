// A button that asks for a text, and gives way to it. `ask` promises the text.

import {element} from "./element.js";

export function asked(label, ask) {
  const button = element("button", {}, label), box = element("div", {class: "asked", "aria-live": "polite"}, button);
  button.onclick = async () => {
    box.replaceChildren("one moment …");
    box.replaceChildren(element("pre", {tabindex: 0}, await ask().catch(error => error.message)));
  };
  return box;
}
