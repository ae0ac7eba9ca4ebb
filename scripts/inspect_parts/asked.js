// A button that asks for a text, and gives way to it. `ask` promises the text; `block` is its side that is to be seen, as of scrollIntoView.

import {element} from "./element.js";

export function asked(label, ask, block = "nearest") {
  const button = element("button", {}, label), box = element("div", {class: "asked", "aria-live": "polite"}, button);
  button.onclick = async () => {
    box.replaceChildren("one moment …");
    try {
      const text = element("pre", {tabindex: 0}, await ask());
      box.replaceChildren(text);
      text.focus({preventScroll: true});
      text.scrollIntoView({block});
    } catch (error) {
      box.replaceChildren(button, ` ${error.message}`);
    }
  };
  return box;
}
