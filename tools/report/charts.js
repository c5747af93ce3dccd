// Sections of kind `scatter`: points by two figures; and `timeline`: what a frame's time goes to.

// Okabe and Ito: told apart by people with any kind of colour vision; yellow and black would be lost on one of the two grounds.
const COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#8c6bb1", "#7f7f7f", "#a6761d", "#66a61e"];
const MARKS = [
  (s) => `M${-s} 0a${s} ${s} 0 1 0 ${2 * s} 0a${s} ${s} 0 1 0 ${-2 * s} 0z`,
  (s) => `M${-s} ${-s}h${2 * s}v${2 * s}h${-2 * s}z`,
  (s) => `M0 ${-1.3 * s}L${1.3 * s} 0L0 ${1.3 * s}L${-1.3 * s} 0z`,
  (s) => `M0 ${-1.2 * s}L${1.2 * s} ${s}H${-1.2 * s}z`,
  (s) => `M0 ${1.2 * s}L${1.2 * s} ${-s}H${-1.2 * s}z`,
];
const WIDTH = 960;
const HEIGHT = 540;
const MARGIN = { left: 78, right: 24, top: 18, bottom: 56 };

function distinct(values) {
  return [...new Set(values)];
}

// 1, 2 and 5 of each decade; of wide ranges the decades alone.
function ticks(low, high) {
  const found = [];
  const wide = Math.log10(high / low) > 3;
  for (let decade = Math.floor(Math.log10(low)); decade <= Math.ceil(Math.log10(high)); ++decade)
    for (const step of wide ? [1] : [1, 2, 5]) found.push(step * 10 ** decade);
  return found.filter((value) => value >= low && value <= high);
}

function logAxis(values, from, to) {
  const low = Math.min(...values) / 1.35;
  const high = Math.max(...values) * 1.5;
  const place = (value) => from + ((to - from) * Math.log(value / low)) / Math.log(high / low);
  return { place, ticks: ticks(low, high) };
}

// Nothing is lower in both figures.
function frontOf(points) {
  let best = Infinity;
  return [...points].sort((a, b) => a.x - b.x || a.y - b.y).filter((point) => point.y < best && ((best = point.y), true));
}

class Scatter {
  constructor(section) {
    this.section = section;
    this.x = 0;
    this.y = 0;
    this.text = "";
    this.groups = distinct(section.points.map((point) => point.group));
    this.marks = distinct(section.points.map((point) => point.mark));
    this.hidden = new Set();
    this.facets = Object.fromEntries(Object.keys(section.points[0]?.facets ?? {}).map((name) => [name, ""]));
    for (const name of section.oneOf ?? []) this.facets[name] = section.points[0].facets[name];
    this.figure = element("div", { class: "chart" });
    this.status = element("span", { class: "quiet", role: "status" });
  }

  points() {
    const { x, y } = this.section.axes;
    const words = this.text.toLowerCase().split(/\s+/).filter(Boolean);
    return this.section.points
      .map((point) => ({ ...point, x: point.values[x[this.x].key], y: point.values[y[this.y].key] }))
      .filter((point) => point.x > 0 && point.y > 0 && !this.hidden.has(point.group) && words.every((word) => this.words(point).includes(word)))
      .filter((point) => Object.entries(this.facets).every(([name, value]) => !value || point.facets[name] === value));
  }

  words(point) {
    return [point.name, point.group, point.mark, ...Object.values(point.facets)].join(" ").toLowerCase();
  }

  lines(point) {
    const { x, y } = this.section.axes;
    return [point.name, `${x[this.x].title}: ${number(point.x)}`, `${y[this.y].title}: ${number(point.y)}`, `${point.mark}; ${point.group}`, ...(point.details ?? [])];
  }

  axis(svg, horizontal, axis, title) {
    const middle = (HEIGHT - MARGIN.bottom + MARGIN.top) / 2;
    for (const value of axis.ticks) {
      const at = axis.place(value);
      svg.append(horizontal
        ? element("line", { class: "grid", x1: at, x2: at, y1: MARGIN.top, y2: HEIGHT - MARGIN.bottom })
        : element("line", { class: "grid", x1: MARGIN.left, x2: WIDTH - MARGIN.right, y1: at, y2: at }));
      svg.append(element("text", horizontal ? { x: at, y: HEIGHT - MARGIN.bottom + 18, "text-anchor": "middle" } : { x: MARGIN.left - 8, y: at + 4, "text-anchor": "end" }, number(value)));
    }
    svg.append(horizontal
      ? element("text", { class: "axis", x: (WIDTH + MARGIN.left) / 2, y: HEIGHT - 12, "text-anchor": "middle" }, title)
      : element("text", { class: "axis", transform: `translate(18 ${middle}) rotate(-90)`, "text-anchor": "middle" }, title));
  }

  front(svg, points, x, y) {
    const steps = frontOf(points);
    if (!steps.length) return;
    let path = `M${x.place(steps[0].x)} ${MARGIN.top}V${y.place(steps[0].y)}`;
    for (const step of steps.slice(1)) path += `H${x.place(step.x)}V${y.place(step.y)}`;
    svg.append(element("path", { class: "front", d: `${path}H${WIDTH - MARGIN.right}` }));
    this.labels(svg, [...steps, ...points.filter((point) => !steps.includes(point))], steps.length, points, x, y);
  }

  // Each beside its point, where it hides neither a point nor another label; where there is no room the tip has the name.
  labels(svg, wanted, first, points, x, y) {
    const taken = points.map((point) => [x.place(point.x) - 7, y.place(point.y) - 7, x.place(point.x) + 7, y.place(point.y) + 7]);
    for (const [i, step] of wanted.entries()) {
      const width = 6.9 * step.name.length;
      const [px, py] = [x.place(step.x), y.place(step.y)];
      const places = [[10, -9], [10, 18], [-width - 10, -9], [-width - 10, 18], [12, 4], [-width - 12, 4], [-width / 2, 26], [-width / 2, -16], [14, 36], [-width - 14, 36]];
      const box = ([dx, dy]) => [px + dx, py + dy - 11, px + dx + width, py + dy + 4];
      const free = places.find((place) => {
        const [x0, y0, x1, y1] = box(place);
        return x0 > MARGIN.left && x1 < WIDTH - 4 && y0 > 4 && y1 < HEIGHT - MARGIN.bottom && !taken.some((t) => x0 < t[2] && x1 > t[0] && y0 < t[3] && y1 > t[1]);
      });
      if (!free) continue;
      taken.push(box(free));
      svg.append(element("text", { class: i < first ? "name" : "name other", x: px + free[0], y: py + free[1] }, step.name));
    }
  }

  mark(point, x, y, first) {
    const shape = MARKS[this.marks.indexOf(point.mark) % MARKS.length](6);
    const colour = COLOURS[this.groups.indexOf(point.group) % COLOURS.length];
    const made = element("g", { role: "option", "aria-selected": "false", tabindex: first ? "0" : "-1", class: "point", transform: `translate(${x.place(point.x)} ${y.place(point.y)})`,
      "aria-label": this.lines(point).join(", ") }, element("path", { d: MARKS[0](13), class: "halo" }), element("path", { d: shape, fill: colour }));
    return withTip(made, () => this.lines(point));
  }

  bars(svg, points, x, y) {
    const { x: xs } = this.section.axes;
    for (const point of points) {
      const range = point.ranges?.[xs[this.x].key];
      if (range?.every((value) => value > 0))
        svg.append(element("line", { class: "range", stroke: COLOURS[this.groups.indexOf(point.group) % COLOURS.length], x1: x.place(range[0]), x2: x.place(range[1]), y1: y.place(point.y), y2: y.place(point.y) }));
    }
  }

  update() {
    const points = this.points().sort((a, b) => a.x - b.x);
    this.status.textContent = `${points.length} of ${this.section.points.length} points`;
    if (!points.length) return this.figure.replaceChildren(element("p", { class: "quiet" }, "No point is left: widen the filter."));
    const reach = points.flatMap((point) => [point.x, ...(point.ranges?.[this.section.axes.x[this.x].key] ?? [])]).filter((value) => value > 0);
    const x = logAxis(reach, MARGIN.left, WIDTH - MARGIN.right);
    const y = logAxis(points.map((point) => point.y), HEIGHT - MARGIN.bottom, MARGIN.top);
    const back = element("g", { "aria-hidden": "true" });
    this.axis(back, true, x, this.section.axes.x[this.x].title);
    this.axis(back, false, y, this.section.axes.y[this.y].title);
    this.front(back, points, x, y);
    this.bars(back, points, x, y);
    const marks = points.map((point, i) => this.mark(point, x, y, i === 0));
    const list = element("g", { role: "listbox", "aria-label": `${this.section.title}: arrow keys go from point to point`, onkeydown: (event) => this.walk(event, marks) }, marks);
    this.figure.replaceChildren(element("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}` }, back, list));
  }

  walk(event, marks) {
    const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    const next = (marks.indexOf(document.activeElement) + step + marks.length) % marks.length;
    marks.forEach((mark, i) => {
      mark.setAttribute("tabindex", i === next ? "0" : "-1");
      mark.setAttribute("aria-selected", String(i === next));
    });
    marks[next].focus();
  }

  controls() {
    const set = (change) => (value) => (change(value), this.update());
    const search = element("input", { type: "search", placeholder: "words to keep", oninput: () => set(() => (this.text = search.value))() });
    const axes = ["x", "y"].filter((name) => this.section.axes[name].length > 1)
      .map((name) => labelled(name === "x" ? "across" : "up", choice(this.section.axes[name].map((axis) => axis.title), set((i) => (this[name] = i)))));
    const facets = Object.keys(this.facets).map((name) => {
      const values = distinct(this.section.points.map((point) => point.facets[name]));
      const all = (this.section.oneOf ?? []).includes(name) ? values : ["", ...values];
      return values.length < 2 ? null : labelled(name, choice(all.map((value) => value || "all"), set((i) => (this.facets[name] = all[i]))));
    });
    return element("div", { class: "controls" }, labelled("filter", search), axes, facets, this.status);
  }

  legend() {
    const group = (name, i) => {
      const box = element("input", { type: "checkbox", checked: true, onchange: () => (box.checked ? this.hidden.delete(name) : this.hidden.add(name), this.update()) });
      return element("label", {}, box, element("span", { class: "swatch", style: `background:${COLOURS[i % COLOURS.length]}`, "aria-hidden": "true" }), name);
    };
    const mark = (name, i) => element("span", { class: "mark" }, element("svg", { viewBox: "-9 -9 18 18", width: "14", height: "14", "aria-hidden": "true" }, element("path", { d: MARKS[i % MARKS.length](6) })), name);
    return element("div", { class: "legend" }, this.groups.map(group), this.marks.length > 1 ? this.marks.map(mark) : null,
      element("span", { class: "mark" }, element("span", { class: "front-swatch", "aria-hidden": "true" }), "nothing is lower in both"));
  }

  show() {
    this.update();
    return [this.controls(), this.figure, this.legend()];
  }
}

SECTIONS.scatter = (section) => (section.points.length ? new Scatter(section).show() : [element("p", { class: "quiet" }, "Nothing could be measured.")]);

// ---- Time

class Timeline {
  constructor(section) {
    this.section = section;
    this.relative = false;
    this.text = "";
    this.list = element("ul", { class: "timeline" });
    const sums = {};
    for (const row of section.rows) for (const part of row.parts) sums[part.name] = (sums[part.name] ?? 0) + part.value;
    this.order = Object.keys(sums).sort((a, b) => sums[b] - sums[a]);
  }

  colour(name) {
    const place = this.order.indexOf(name);
    return place < COLOURS.length ? COLOURS[place] : "var(--rest)";
  }

  row(row, whole) {
    const total = row.parts.reduce((sum, part) => sum + part.value, 0);
    const say = (part) => `${part.name}: ${number(part.value)} ${this.section.unit}, ${number(Number(((100 * part.value) / total || 0).toPrecision(3)))} %`;
    const bar = element("span", { class: "bars", "aria-hidden": "true" }, row.parts.map((part) =>
      withTip(element("span", { style: `width:${(100 * part.value) / (this.relative ? total : whole)}%;background:${this.colour(part.name)}` }), () => [row.name, say(part)])));
    const details = element("ol", { hidden: true, id: uniqueId("passes") }, row.parts.map((part) =>
      element("li", {}, element("span", { class: "swatch", style: `background:${this.colour(part.name)}`, "aria-hidden": "true" }), say(part))));
    const button = element("button", { type: "button", "aria-expanded": "false", "aria-controls": details.id, onclick: () => {
      details.hidden = !details.hidden;
      button.setAttribute("aria-expanded", String(!details.hidden));
    } }, element("span", { class: "name" }, row.name), element("span", { class: "total" }, `${number(total)} ${this.section.unit}`), bar);
    return element("li", {}, button, details);
  }

  update() {
    const words = this.text.toLowerCase().split(/\s+/).filter(Boolean);
    const rows = this.section.rows.filter((row) => words.every((word) => row.name.toLowerCase().includes(word)));
    const total = (row) => row.parts.reduce((sum, part) => sum + part.value, 0);
    const whole = Math.max(...rows.map(total));
    this.list.replaceChildren(...rows.map((row) => this.row(row, whole)));
  }

  legend() {
    const parts = this.order.slice(0, COLOURS.length).map((name) => element("span", { class: "mark" }, element("span", { class: "swatch", style: `background:${this.colour(name)}`, "aria-hidden": "true" }), name));
    const rest = this.order.length > COLOURS.length ? element("span", { class: "mark" }, element("span", { class: "swatch", style: "background:var(--rest)", "aria-hidden": "true" }), `${this.order.length - COLOURS.length} smaller ones`) : null;
    return element("div", { class: "legend" }, parts, rest);
  }

  show() {
    this.update();
    if (this.section.rows.length < 3) return [this.list, this.legend()];
    const search = element("input", { type: "search", placeholder: "words to keep", oninput: () => ((this.text = search.value), this.update()) });
    const scale = choice(["the same for all", "each row its own"], (i) => ((this.relative = i === 1), this.update()));
    return [element("div", { class: "controls" }, labelled("filter", search), labelled("scale", scale)), this.list, this.legend()];
  }
}

SECTIONS.timeline = (section) => new Timeline(section).show();
