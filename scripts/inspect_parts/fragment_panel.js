// zbuf's report on a pixel.

import {element} from "./element.js";

export class FragmentPanel {
  constructor(title, table, fragments) {
    Object.assign(this, {title, body: table.tBodies[0], fragments});
  }

  // Calls `select(name)` when a fragment is chosen.
  tell(p, select) {
    const {fragments} = this;
    this.title.textContent = p < 0 ? "Point at a pixel to see every fragment that competed for it." :
      fragments.told(p) + (fragments.leftOut ? ` (${fragments.leftOut} fragments of the picture that lost are left out)` : "");
    this.body.replaceChildren(...(p < 0 ? [] : fragments.fragmentsOf(p)).map(({triangle, depth, fate, isSeen}) => {
      const cells = [element("button", {"aria-label": `select triangle ${triangle}`}, triangle), depth, fate === "kept" && !isSeen ? "kept, until a nearer one came" : fate];
      const row = element("tr", {class: isSeen ? "seen" : "", "data-name": triangle}, ...cells.map(cell => element("td", {}, cell)));
      row.onclick = () => select(triangle);
      return row;
    }));
  }

  highlight(name) {
    for (const row of this.body.rows) row.classList.toggle("hot", Number(row.dataset.name) === name);
  }
}
