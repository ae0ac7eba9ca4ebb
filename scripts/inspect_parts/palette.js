// The page's colors, which follow the reader's choice of dark or light.

export class Palette {
  constructor(element, signal) {
    this.element = element;
    this.words = new Map();
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.words.clear(), {signal});
  }

  word(name) {
    if (!this.words.has(name)) this.words.set(name, getComputedStyle(this.element).getPropertyValue(name).trim());
    return this.words.get(name);
  }

  // Red, green and blue of a color that is written #rrggbb.
  numbers(name) { return [1, 3, 5].map(at => parseInt(this.word(name).slice(at, at + 2), 16)); }
}
