// zbuf's report on a pixel.

export class FragmentPanel {
  constructor(title, table, fragments) {
    Object.assign(this, {title, body: table.tBodies[0], fragments});
  }

  // `select(name)` is called for a fragment that is chosen.
  tell(p, select) {
    const {fragments} = this;
    this.title.textContent = p < 0 ? "Point at a pixel to see every fragment that competed for it." :
      fragments.told(p) + (fragments.leftOut ? ` (${fragments.leftOut} fragments of the picture that lost are left out)` : "");
    this.body.replaceChildren(...(p < 0 ? [] : fragments.fragmentsOf(p)).map(({triangle, depth, fate, isSeen}) => {
      const row = document.createElement("tr"), button = document.createElement("button");
      button.textContent = triangle;
      button.setAttribute("aria-label", `select triangle ${triangle}`);
      row.insertCell().append(button);
      row.insertCell().textContent = depth;
      row.insertCell().textContent = fate === "kept" && !isSeen ? "kept, until a nearer one came" : fate;
      row.className = isSeen ? "seen" : "";
      row.dataset.name = triangle;
      row.onclick = () => select(triangle);
      return row;
    }));
  }

  highlight(name) {
    for (const row of this.body.rows) row.classList.toggle("hot", Number(row.dataset.name) === name);
  }
}
