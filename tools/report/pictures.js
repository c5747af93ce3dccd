// Sections of kind `pictures`: picture, reference and difference under one slider, a probe, and how values and errors are spread.

const LAYERS = ["rendered", "reference", "difference"];
const LAYER_NAMES = ["picture", "reference", "difference"];
const LOUPE = 11; // pixels a side
const ERROR_DECADES = [-6, 1];
const LEAST_WIDTH = 560; // of a small picture on the screen

class Pictures {
  constructor(section) {
    this.section = section;
    this.stops = 0;
    this.channel = 0;
    this.position = 0.5;
    this.pixel = [0, 0];
    this.canvas = element("canvas", { "aria-hidden": "true" });
    this.border = element("div", { class: "border", "aria-hidden": "true" });
    this.cross = element("div", { class: "cross", "aria-hidden": "true" });
    this.left = element("span", { class: "side", "aria-hidden": "true" });
    this.right = element("span", { class: "side right", "aria-hidden": "true" });
    this.stage = element("div", { class: "stage", tabindex: "0", role: "application", "aria-label": "picture; arrow keys move the probe, with Shift by ten pixels, w goes to the worst pixel, 1, 2 and 3 show one of the three",
      onkeydown: (event) => this.key(event), onpointermove: (event) => event.buttons === 0 && this.point(event), onpointerdown: (event) => this.point(event) }, this.canvas, this.border, this.cross, this.left, this.right);
    this.slider = element("input", { type: "range", min: "0", max: "2", step: "0.005", value: this.position, list: uniqueId("stops"), oninput: () => this.slide(Number(this.slider.value)) });
    this.values = element("div", { class: "values" });
    this.spoken = element("p", { class: "hidden", "aria-live": "polite" });
    this.loupes = LAYERS.map(() => element("canvas", { width: LOUPE, height: LOUPE, "aria-hidden": "true" }));
    this.spread = element("div", { class: "spreads" });
    this.about = element("p", { class: "note" });
  }

  async open(index) {
    const subject = this.section.subjects[index];
    const planes = await Promise.all(LAYERS.map((layer) => (subject[layer] ? openPlane(subject[layer]) : null)));
    this.subject = subject;
    this.planes = planes;
    const { width, height } = planes[0];
    this.canvas.width = width;
    this.canvas.height = height;
    this.stage.style.width = `${width * Math.max(1, Math.round(LEAST_WIDTH / width))}px`;
    this.stage.style.aspectRatio = `${width} / ${height}`;
    this.about.textContent = subject.note ?? "";
    this.channels.disabled = planes[0].channels < 2;
    this.repaint();
    this.probe(...this.worst());
    this.histograms();
    document.body.dataset.opened = subject.name;
  }

  repaint() {
    const channel = this.channel <= this.planes[0].channels ? this.channel : 0;
    this.painted = this.planes.map((plane, i) => {
      if (!plane) return null;
      const image = i === 2 ? paintDifference(plane, channel) : paintLevels(plane, this.subject.levels, channel, this.stops);
      const canvas = element("canvas", { width: plane.width, height: plane.height });
      canvas.getContext("2d").putImageData(image, 0, 0);
      return canvas;
    });
    this.compose();
  }

  // At 0 the picture, at 1 the reference, at 2 the difference; between them a border, which moves as the slider does.
  compose() {
    const context = this.canvas.getContext("2d");
    const first = Math.min(Math.floor(this.position), 1);
    const border = Math.round((this.position - first) * this.canvas.width);
    if (this.painted[first]) context.drawImage(this.painted[first], 0, 0);
    if (border > 0 && this.painted[first + 1]) context.drawImage(this.painted[first + 1], 0, 0, border, this.canvas.height, 0, 0, border, this.canvas.height);
    const share = border / this.canvas.width;
    this.border.hidden = share <= 0 || share >= 1;
    this.border.style.left = `${100 * share}%`;
    this.left.textContent = share > 0 ? LAYER_NAMES[first + 1] : "";
    this.right.textContent = share < 1 ? LAYER_NAMES[first] : "";
    this.slider.setAttribute("aria-valuetext", share <= 0 ? LAYER_NAMES[first] : share >= 1 ? LAYER_NAMES[first + 1] : `${LAYER_NAMES[first + 1]} left of ${Math.round(100 * share)} %, ${LAYER_NAMES[first]} right of it`);
  }

  slide(position) {
    this.position = position;
    this.slider.value = position;
    this.compose();
  }

  worst() {
    const plane = this.planes[2];
    if (!plane) return [this.planes[0].width >> 1, this.planes[0].height >> 1];
    let best = 0;
    let most = -1;
    for (let i = 0; i < plane.width * plane.height; ++i) {
      const value = largestDifference(plane, i, 0);
      if (!(value <= most)) [best, most] = [i, Number.isNaN(value) ? Infinity : value];
    }
    return [best % plane.width, Math.floor(best / plane.width)];
  }

  point(event) {
    const box = this.canvas.getBoundingClientRect();
    this.probe(Math.floor(((event.clientX - box.x) / box.width) * this.canvas.width), Math.floor(((event.clientY - box.y) / box.height) * this.canvas.height));
  }

  key(event) {
    const moves = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    if (moves[event.key]) {
      const step = event.shiftKey ? 10 : 1;
      this.probe(this.pixel[0] + step * moves[event.key][0], this.pixel[1] + step * moves[event.key][1], true);
    } else if (event.key === "w") this.probe(...this.worst(), true);
    else if ("123".includes(event.key)) this.slide(Number(event.key) - 1);
    else return;
    event.preventDefault();
  }

  probe(x, y, aloud) {
    const { width, height } = this.planes[0];
    this.pixel = [Math.min(Math.max(x, 0), width - 1), Math.min(Math.max(y, 0), height - 1)];
    [x, y] = this.pixel;
    this.cross.style.cssText = `left:${(100 * x) / width}%;top:${(100 * y) / height}%;width:${100 / width}%;height:${100 / height}%`;
    this.loupes.forEach((loupe, i) => {
      const context = loupe.getContext("2d");
      context.clearRect(0, 0, LOUPE, LOUPE);
      if (this.painted[i]) context.drawImage(this.painted[i], x - (LOUPE - 1) / 2, y - (LOUPE - 1) / 2, LOUPE, LOUPE, 0, 0, LOUPE, LOUPE);
    });
    this.tell(x, y, aloud);
  }

  tell(x, y, aloud) {
    const { width, height, channels } = this.planes[0];
    const pixel = y * width + x;
    const names = channels === 1 ? ["value"] : ["red", "green", "blue", "alpha"].slice(0, channels);
    const rows = names.map((name, c) => [name, ...this.planes.map((plane) => (plane && c < plane.channels ? number(valueAt(plane, pixel, c)) : "–"))]);
    const head = ["", ...LAYER_NAMES];
    this.values.replaceChildren(element("p", { class: "place" }, `pixel ${x}, ${y}; uv ${((x + 0.5) / width).toFixed(4)}, ${((y + 0.5) / height).toFixed(4)}`),
      element("table", {}, element("thead", {}, element("tr", {}, head.map((name) => (name ? element("th", { scope: "col", class: "number" }, name) : element("td"))))),
        element("tbody", {}, rows.map((row) => element("tr", {}, element("th", { scope: "row" }, row[0]), row.slice(1).map((value) => element("td", { class: "number" }, value)))))));
    if (this.errorMark && this.planes[2]) this.markError(largestDifference(this.planes[2], pixel, 0));
    if (aloud) this.spoken.textContent = `pixel ${x}, ${y}: ${rows.map((row) => `${row[0]} ${row[1]}, reference ${row[2]}, difference ${row[3]}`).join("; ")}`;
  }

  markError(error) {
    const at = (Math.log10(error) - ERROR_DECADES[0]) / (ERROR_DECADES[1] - ERROR_DECADES[0]);
    this.errorMark.setAttribute("visibility", error > 0 && Number.isFinite(at) ? "visible" : "hidden");
    const place = 300 * Math.min(Math.max(at, 0), 1);
    this.errorMark.setAttribute("x1", place);
    this.errorMark.setAttribute("x2", place);
  }

  histograms() {
    const made = [];
    if (this.planes[2]) made.push(this.errorHistogram());
    made.push(this.valueHistogram());
    this.spread.replaceChildren(...made.filter(Boolean));
    this.probe(...this.pixel);
  }

  errorHistogram() {
    const bins = new Array(56).fill(0);
    const plane = this.planes[2];
    let alike = 0;
    for (let i = 0; i < plane.width * plane.height; ++i) {
      const error = largestDifference(plane, i, this.channel);
      if (!(error > 0)) ++alike;
      else ++bins[Math.min(Math.max(Math.floor(((Math.log10(error) - ERROR_DECADES[0]) / (ERROR_DECADES[1] - ERROR_DECADES[0])) * bins.length), 0), bins.length - 1)];
    }
    const most = Math.max(...bins, 1);
    this.errorMark = element("line", { class: "mark-line", y1: 0, y2: 90 });
    const bars = bins.map((count, i) => element("rect", { x: (300 / bins.length) * i, width: 300 / bins.length - 0.6, y: 90 - (88 * count) / most, height: (88 * count) / most,
      fill: `rgb(${rampColour(10 ** (ERROR_DECADES[0] + ((i + 0.5) * (ERROR_DECADES[1] - ERROR_DECADES[0])) / bins.length)).map(Math.round).join(" ")})` }));
    const ends = [-6, -4, -2, 0].map((power) => element("text", { x: (300 * (power - ERROR_DECADES[0])) / 7, y: 104, "text-anchor": power === -6 ? "start" : "middle" }, power === 0 ? "1" : `1e${power}`.replace("-", "−")));
    return element("figure", {}, element("figcaption", {}, `Differences, of the mean; ${number(alike)} of ${number(plane.width * plane.height)} pixels do not differ or do not count. The line is the probe's.`),
      element("svg", { viewBox: "0 0 300 108", role: "img", "aria-label": `differences by decade: ${this.decades(bins)}` }, element("rect", { class: "ground", width: 300, height: 90 }), bars, this.errorMark, ends));
  }

  decades(bins) {
    return [0, 1, 2, 3, 4, 5, 6].map((d) => `1e${d - 6} to 1e${d - 5}: ${bins.slice(8 * d, 8 * d + 8).reduce((a, b) => a + b, 0)}`).join(", ");
  }

  valueHistogram() {
    const channel = Math.max(this.channel - 1, 0);
    const pixels = this.planes[0].width * this.planes[0].height;
    const values = this.planes.slice(0, 2).map((plane) => {
      const found = [];
      if (plane && channel < plane.channels) for (let i = 0; i < pixels; ++i) if (Number.isFinite(valueAt(plane, i, channel)) && valueAt(plane, i, channel) !== 0) found.push(valueAt(plane, i, channel));
      return found.sort((a, b) => a - b);
    });
    const all = values.find((list) => list.length);
    if (!all) return null;
    const low = Math.min(...values.filter((list) => list.length).map((list) => list[Math.floor(0.002 * list.length)]));
    const high = Math.max(...values.filter((list) => list.length).map((list) => list[Math.ceil(0.998 * list.length) - 1]));
    const line = (list) => {
      const bins = new Array(60).fill(0);
      for (const value of list) if (value >= low && value <= high) ++bins[Math.min(Math.floor(((value - low) / (high - low || 1)) * bins.length), bins.length - 1)];
      return bins;
    };
    const lines = values.map(line);
    const most = Math.max(...lines.flat(), 1);
    const path = (bins) => `M0 90${bins.map((count, i) => `L${5 * i} ${90 - (88 * count) / most}H${5 * i + 5}`).join("")}V90`;
    return element("figure", {}, element("figcaption", {}, `Values of the ${this.planes[0].channels === 1 ? "map" : ["red", "green", "blue", "alpha"][channel]} that are not 0; filled: picture, line: reference.`),
      element("svg", { viewBox: "0 0 300 108", role: "img", "aria-label": `values from ${number(low)} to ${number(high)}` }, element("rect", { class: "ground", width: 300, height: 90 }),
        element("path", { class: "filled", d: path(lines[0]) }), element("path", { class: "outline", d: path(lines[1]) }),
        element("text", { x: 0, y: 104 }, number(low)), element("text", { x: 300, y: 104, "text-anchor": "end" }, number(high))));
  }

  list() {
    const name = uniqueId("subject");
    const groups = new Map();
    this.section.subjects.forEach((subject, i) => {
      const radio = element("input", { type: "radio", name, value: i, checked: i === 0, onchange: () => this.open(i) });
      const item = element("label", {}, radio, element("span", {}, subject.name), subject.worst === undefined ? null : element("small", {}, `≤ ${number(subject.worst)}`));
      groups.set(subject.group, [...(groups.get(subject.group) ?? []), item]);
    });
    return element("div", { class: "subjects", role: "radiogroup", "aria-label": this.section.title, tabindex: "-1" }, [...groups].map(([group, items]) => [group ? element("p", { class: "group" }, group) : null, items]));
  }

  controls() {
    const exposure = element("input", { type: "range", min: "-8", max: "8", step: "0.5", value: "0", oninput: () => {
      this.stops = Number(exposure.value);
      exposure.setAttribute("aria-valuetext", `${this.stops} stops`);
      this.repaint();
      this.probe(...this.pixel);
    } });
    this.channels = choice(["colour", "red", "green", "blue", "alpha"], (i) => {
      this.channel = i;
      this.repaint();
      this.histograms();
    });
    const snap = LAYER_NAMES.map((name, i) => element("button", { type: "button", onclick: () => this.slide(i) }, name));
    return [element("div", { class: "wipe" }, element("label", { class: "hidden", for: (this.slider.id = uniqueId("wipe")) }, "picture, reference, difference"), this.slider, element("div", { class: "snaps" }, snap)),
      element("div", { class: "controls" }, labelled("exposure", exposure), labelled("channel", this.channels), element("button", { type: "button", onclick: () => this.probe(...this.worst(), true) }, "worst pixel"))];
  }

  show() {
    const loupes = element("div", { class: "loupes" }, this.loupes.map((loupe, i) => element("figure", {}, loupe, element("figcaption", {}, LAYER_NAMES[i]))));
    const scale = element("div", { class: "scale" }, element("div", { class: "ramp", style: `background:linear-gradient(to right,${RAMP.map((c) => `rgb(${c.join(" ")})`).join(",")})`, role: "img", "aria-label": "colours of differences, from a millionth of the mean to all of it" }),
      element("div", { class: "ends" }, ["1e−6", "1e−4", "1e−2", "1"].map((text) => element("span", {}, text))));
    const [wipe, controls] = this.controls();
    this.open(0);
    return [element("div", { class: "pictures" }, this.list(), element("div", { class: "view" }, this.stage, wipe, controls, this.about),
      element("div", { class: "beside" }, loupes, this.values, this.spoken, scale, this.spread))];
  }
}

SECTIONS.pictures = (section) => (section.subjects.length ? new Pictures(section).show() : [element("p", { class: "quiet" }, "No pictures.")]);
