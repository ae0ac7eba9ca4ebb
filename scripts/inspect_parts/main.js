// Assembles the page: pointing at something in one panel highlights it in all.

const STARTS = {
  model: {yaw: -0.6, pitch: 0.45},
  view: {yaw: -0.6, pitch: 0.35},
  project: {yaw: -0.45, pitch: 0.3},
};

function stageSection(stage) {
  const section = document.createElement("section");
  section.innerHTML = `<h2>${stage.tool} <span>${stage.title}</span> <span>${stage.remark && "(" + stage.remark + ")"}</span></h2><div><div class="stack"><canvas id="wire-${stage.tool}"></canvas><canvas></canvas></div><div class="text" id="text-${stage.tool}"></div></div>`;
  document.getElementById("stages").append(section);
  return section.querySelectorAll("canvas");
}

// What --stats counts, without zeros: "19 seen, 3 hidden".
function countsOf(statistics) {
  return statistics.filter(([key, word]) => !/^triangles$|_(min|max)$/.test(key) && word !== "0").map(([key, word]) => `${word} ${key.replaceAll("_", " ")}`).join(", ");
}

// "-1.5 to 2", with four digits.
function rangeOf(statistics, axis) {
  const words = new Map(statistics), short = end => String(Number(Number(words.get(`${axis}_${end}`)).toPrecision(4)));
  return words.has(axis + "_min") ? `${short("min")} to ${short("max")}` : "";
}

function tellCounts(data) {
  document.getElementById("title").textContent = `${data.scene} through the pipe (${data.config}: ${data.columns} x ${data.rows} pixels)`;
  const size = bytes => bytes < 1e6 ? `${(bytes / 1e3).toFixed(1)} kB` : `${(bytes / 1e6).toFixed(1)} MB`;
  const notes = [...data.notes];
  if (data.step > 1) notes.unshift(`Of ${data.triangles} triangles every ${data.step}th is drawn and printed here; pixels know all of them.`);
  document.getElementById("notes").textContent = notes.join(" ");
  for (const stage of data.stages) {
    const row = document.querySelector("#counts tbody").insertRow();
    for (const words of [stage.tool, stage.title, stage.triangles, size(stage.bytes), stage.seconds > 0 ? `${Math.round(1000 * stage.seconds)} ms` : "< 1 ms",
      countsOf(stage.statistics), ...["x", "y", "z"].map(axis => rangeOf(stage.statistics, axis))]) row.insertCell().textContent = words;
  }
}

class Inspector {
  constructor(data) {
    tellCounts(data);
    this.held = -1;         // the triangle that was clicked
    this.isPixelHeld = false;
    this.panels = [];
    for (const stage of data.stages.slice(0, 3)) this.addStage(stage);
    this.pixels = new PixelPanel(data);
    const z = data.stages[3];
    this.depthText = new TextPanel(document.getElementById("text-zbuf"), z.text, () => -1);
    this.pixels.listen(p => this.pointAtPixel(p), p => this.clickPixel(p));
    this.follow(location.hash);
    document.body.dataset.ready = "yes";
  }

  addStage(stage) {
    const wire = new Wireframe(...stageSection(stage), stage, STARTS[stage.tool]);
    const names = intsOf(stage.names), firstLines = intsOf(stage.firstLines), linesOf = new Map(), nameOfLine = new Map();
    names.forEach((name, i) => {
      const lines = [firstLines[i], firstLines[i] + 1, firstLines[i] + 2];
      linesOf.set(name, [...(linesOf.get(name) || []), ...lines]);
      lines.forEach(line => nameOfLine.set(line, name));
    });
    const text = new TextPanel(document.getElementById("text-" + stage.tool), stage.text, line => nameOfLine.has(line) ? nameOfLine.get(line) : -1);
    wire.listen(name => this.point(name), name => this.select(name));
    text.listen(name => this.point(name), name => this.select(name));
    this.panels.push({wire, text, linesOf});
  }

  // Shows a triangle everywhere; -1 shows none.
  show(name, isToBeSeen) {
    if (document.body.dataset.triangle === String(name)) return;
    document.body.dataset.triangle = name;
    for (const {wire, text, linesOf} of this.panels) {
      wire.highlight(name);
      text.highlight(linesOf.get(name) || [], isToBeSeen);
    }
    this.pixels.highlight(name);
  }

  point(name) { this.show(name >= 0 ? name : this.held, false); }

  select(name) {
    this.held = name;
    if (name < 0) this.isPixelHeld = false;
    document.body.dataset.triangle = "";
    this.show(name, true);
  }

  // "#pixel=COLUMN,ROW" or "#triangle=N" in the address selects one.
  follow(hash) {
    const pixel = hash.match(/^#pixel=(\d+),(\d+)$/), triangle = hash.match(/^#triangle=(\d+)$/);
    if (pixel && Number(pixel[1]) < this.pixels.columns && Number(pixel[2]) < this.pixels.rows)
      this.clickPixel(Number(pixel[2]) * this.pixels.columns + Number(pixel[1]));
    if (triangle) this.select(Number(triangle[1]));
  }

  pointAtPixel(p) {
    if (this.isPixelHeld) return;
    this.pixels.tell(p, name => this.select(name));
    this.point(this.pixels.owner(p));
  }

  clickPixel(p) {
    this.isPixelHeld = true;
    this.pixels.tell(p, name => this.select(name));
    this.held = this.pixels.owner(p);
    document.body.dataset.triangle = "";
    this.show(this.held, true);
    if (this.held < 0) this.isPixelHeld = false;
    this.depthText.highlight([Math.floor(p / this.pixels.columns) + 1], true);
  }
}

inflated(document.getElementById("data").textContent.trim()).then(data => { window.inspector = new Inspector(data); });
