// A double click on a panel's caption, or F8 in it, lets it fill the window, until the next or Escape.

const PANELS = "figure, #pixel, #texts > section, #drawer, #source > section, #own", CAPTIONS = "figcaption, h2, summary, #tabs, .enlarge";

export class Enlarging {
  // Calls `changed` when other panels have come into sight.
  constructor(changed) {
    this.changed = changed;
    this.id = "";  // of the panel, or of the first part of it that has one, since the inspector makes its panels anew
    document.addEventListener("dblclick", event => { if (event.target.closest(CAPTIONS) && !event.target.closest("button, select")) this.toggle(event.target); });
    document.addEventListener("keydown", event => {
      if (event.key === "F8") this.toggle(event.target);
      else if (event.key === "Escape" && this.id && !event.defaultPrevented) this.show("");
      else return;
      event.preventDefault();
      event.stopPropagation();  // or Escape would release the selection, too
    }, {capture: true});
  }

  // The panel that fills the window.
  get panel() { return document.getElementById(this.id)?.closest(PANELS); }

  isOnScreen(element) {
    const {top, bottom, width} = element.getBoundingClientRect();
    return width > 0 && bottom > 0 && top < innerHeight && (!this.id || Boolean(this.panel?.contains(element)));
  }

  toggle(target) {
    const panel = target.closest(PANELS);
    if (panel) this.show(panel.matches(".large") ? "" : panel.id || panel.querySelector("[id]").id);
  }

  show(id = this.id) {
    this.id = id;
    for (const panel of document.querySelectorAll(".large")) panel.classList.remove("large");
    if (this.panel) this.panel.classList.add("large");
    this.changed();
  }
}
