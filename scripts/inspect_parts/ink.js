// Draws hundreds of thousands of lines, which a canvas takes seconds to stroke. A line leaves ink on the pixels along it, and ink piles
// up to a denser tone, so that no line of a fine mesh is lost and none hides another.

const GAIN = 1.9;         // a single line covers 1 - exp(-GAIN) of its color
const LEAST_WEIGHT = 0.2; // of a line shorter than a pixel

export class Ink {
  constructor(width, height, count) {
    Object.assign(this, {width, height, layers: Array.from({length: count}, () => new Float32Array(width * height))});
  }

  clear() { for (const layer of this.layers) layer.fill(0); }

  // From (x0, y0) to (x1, y1) in pixels, of which (0.5, 0.5) is the center of the first.
  line(layer, x0, y0, x1, y1) {
    const right = this.width - 1, bottom = this.height - 1;
    if (x0 < 1 || x1 < 1 || y0 < 1 || y1 < 1 || x0 >= right || x1 >= right || y0 >= bottom || y1 >= bottom) {
      let first = 0, last = 1;  // Liang and Barsky, 1984
      const dx = x1 - x0, dy = y1 - y0;
      for (const [p, q] of [[-dx, x0 - 1], [dx, right - 0.001 - x0], [-dy, y0 - 1], [dy, bottom - 0.001 - y0]]) {
        if (p === 0 && q < 0) return;
        if (p < 0) first = Math.max(first, q / p);
        if (p > 0) last = Math.min(last, q / p);
      }
      if (!(first < last)) return;
      [x0, y0, x1, y1] = [x0 + first * dx, y0 + first * dy, x0 + last * dx, y0 + last * dy];
    }
    const cells = this.layers[layer], width = this.width, dx = x1 - x0, dy = y1 - y0, isFlat = Math.abs(dx) >= Math.abs(dy);
    const count = Math.max(1, Math.ceil(Math.abs(isFlat ? dx : dy))), weight = Math.max(LEAST_WEIGHT, Math.sqrt(dx * dx + dy * dy) / count);
    for (let i = 0; i < count; ++i) {
      const t = (i + 0.5) / count, x = x0 + t * dx, y = y0 + t * dy;
      if (isFlat) {  // shared by the two pixels whose centers are above and below
        const row = Math.floor(y - 0.5), share = y - 0.5 - row, at = row * width + Math.floor(x);
        cells[at] += weight * (1 - share);
        cells[at + width] += weight * share;
      } else {
        const column = Math.floor(x - 0.5), share = x - 0.5 - column, at = Math.floor(y) * width + column;
        cells[at] += weight * (1 - share);
        cells[at + 1] += weight * share;
      }
    }
  }

  // Colors are [r, g, b]; the last layer lies on top.
  paint(context, paper, colors) {
    const picture = context.createImageData(this.width, this.height), pixels = picture.data, gains = this.layers.map(layer => this.gainOf(layer));
    for (let i = 0; i < this.width * this.height; ++i) {
      let [r, g, b] = paper;
      for (let k = 0; k < colors.length; ++k) {
        const amount = this.layers[k][i];
        if (amount === 0) continue;
        const cover = 1 - Math.exp(-gains[k] * amount);
        r += cover * (colors[k][0] - r);
        g += cover * (colors[k][1] - g);
        b += cover * (colors[k][2] - b);
      }
      pixels[4 * i] = r;
      pixels[4 * i + 1] = g;
      pixels[4 * i + 2] = b;
      pixels[4 * i + 3] = 255;
    }
    context.putImageData(picture, 0, 0);
  }

  // The weight of ink in a layer: the less, the more ink its inked pixels have on average.
  gainOf(layer) {
    let total = 0, count = 0;
    for (const amount of layer) if (amount > 0) { total += amount; ++count; }
    return GAIN / Math.max(1, 0.9 * total / Math.max(1, count));
  }
}
