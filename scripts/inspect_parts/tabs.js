// A row of tabs, of which one shows its panel (WAI-ARIA Authoring Practices, "Tabs").

export class Tabs {
  // Calls `changed` after another panel has become visible.
  constructor(list, changed) {
    this.tabs = [...list.querySelectorAll('[role="tab"]')].filter(tab => !tab.hidden);
    this.changed = changed;
    this.tabs.forEach((tab, i) => {
      tab.onclick = () => this.show(i);
      tab.onkeydown = event => {
        const step = {ArrowLeft: -1, ArrowRight: 1}[event.key];
        if (!step) return;
        event.preventDefault();
        this.show((i + step + this.tabs.length) % this.tabs.length);
        this.tabs.find(other => other.tabIndex === 0).focus();
      };
    });
  }

  show(index) {
    this.shown = index;
    this.tabs.forEach((tab, i) => {
      tab.setAttribute("aria-selected", i === index);
      tab.tabIndex = i === index ? 0 : -1;
      document.getElementById(tab.getAttribute("aria-controls")).hidden = i !== index;
    });
    this.changed();
  }
}
