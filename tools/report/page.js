// The page: its frame, and sections of kind `table` and `notes`. Other kinds add themselves to SECTIONS.

const SECTIONS = {};

function element(tag, attributes = {}, ...children) {
  const namespace = ["svg", "g", "path", "line", "rect", "text", "circle", "polyline"].includes(tag) ? "http://www.w3.org/2000/svg" : null;
  const made = namespace ? document.createElementNS(namespace, tag) : document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else if (value === true) made.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined) made.setAttribute(name, value);
  }
  made.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined));
  return made;
}

function number(value) {
  if (value === null || value === undefined) return "–";
  if (typeof value !== "number") return String(value);
  if (!Number.isFinite(value)) return Number.isNaN(value) ? "not a number" : value > 0 ? "∞" : "−∞";
  if (value === 0) return "0";
  if (Number.isInteger(value) && Math.abs(value) < 1e9) return value.toLocaleString("en").replace("-", "−").replaceAll(",", " ");
  const size = Math.abs(value);
  const text = size < 1e-3 || size >= 1e6 ? value.toExponential(2) : String(Number(value.toPrecision(4)));
  return text.replaceAll("-", "−");
}

let nextId = 0;
function uniqueId(stem) {
  return `${stem}-${++nextId}`;
}

function labelled(text, control) {
  control.id ||= uniqueId("control");
  return element("span", { class: "field" }, element("label", { for: control.id }, text), control);
}

function choice(names, onchange, chosen = 0) {
  const select = element("select", { onchange: () => onchange(select.selectedIndex) }, names.map((name) => element("option", {}, name)));
  select.selectedIndex = chosen;
  return select;
}

// ---- A tip beside the pointer or the focus; what it says stands in the element's own name, too

const tip = element("div", { class: "tip", "aria-hidden": "true", hidden: true });

function showTip(lines, x, y) {
  tip.replaceChildren(element("strong", {}, lines[0]), ...lines.slice(1).map((line) => element("div", {}, line)));
  tip.hidden = false;
  const left = x + 14 + tip.offsetWidth > innerWidth ? x - 14 - tip.offsetWidth : x + 14;
  const top = Math.min(y + 14, innerHeight - tip.offsetHeight - 8);
  tip.style.left = `${Math.max(left, 4)}px`;
  tip.style.top = `${Math.max(top, 4)}px`;
}

function withTip(made, lines) {
  made.addEventListener("pointermove", (event) => showTip(lines(), event.clientX, event.clientY));
  made.addEventListener("pointerleave", () => (tip.hidden = true));
  made.addEventListener("focus", () => {
    const box = made.getBoundingClientRect();
    showTip(lines(), box.x + box.width / 2, box.y + box.height / 2);
  });
  made.addEventListener("blur", () => (tip.hidden = true));
  return made;
}
addEventListener("keydown", (event) => event.key === "Escape" && (tip.hidden = true));

// ---- Tables

const GOOD = new Set(["pass", "passed", "better", "yes"]);
const BAD = new Set(["fail", "failed", "worse", "error", "no"]);

function verdictPill(word) {
  const kind = GOOD.has(word.toLowerCase()) ? "good" : BAD.has(word.toLowerCase()) ? "bad" : word === "warning" ? "warn" : "none";
  return element("span", { class: `pill ${kind}` }, word || "–");
}

// A share of a limit, on a logarithmic bar from a thousandth to all of it.
function shareBar(share) {
  if (share === null) return "–";
  const full = Math.min(Math.max(1 + Math.log10(Math.max(share, 1e-9)) / 3, 0.01), 1);
  return element("span", { class: "share" }, element("span", { class: "track", "aria-hidden": "true" },
    element("span", { class: share > 1 ? "bar bad" : "bar", style: `width:${100 * full}%` })), element("span", { class: "percent" }, `${number(Number((100 * share).toPrecision(3)))} %`));
}

function cell(value, kind) {
  if (kind === "verdict") return element("td", {}, verdictPill(String(value ?? "")));
  if (kind === "share") return element("td", { class: "number" }, shareBar(value));
  if (kind === "number") return element("td", { class: "number" }, number(value));
  return element("td", {}, kind === "code" && value ? element("code", {}, value) : (value ?? "–"));
}

function compareCells(a, b) {
  if (a === null || b === null) return (a === null) - (b === null); // what is unknown comes last
  return typeof a === "number" && typeof b === "number" ? a - b : String(a).localeCompare(String(b), "en", { numeric: true });
}

class Table {
  constructor(section) {
    this.section = section;
    this.text = "";
    this.column = -1;
    this.descending = false;
    this.verdicts = section.columns.findIndex((column) => column.kind === "verdict");
    this.chosen = "";
    this.count = element("span", { class: "quiet", role: "status" });
    this.body = element("tbody");
    this.heads = section.columns.map((column, i) => this.head(column, i));
  }

  head(column, i) {
    const numeric = column.kind === "number" || column.kind === "share";
    const button = element("button", { type: "button", title: column.help || null, onclick: () => this.sortBy(i) }, column.title || "verdict");
    return element("th", { scope: "col", class: numeric ? "number" : null, "aria-sort": "none" }, button);
  }

  sortBy(column) {
    this.descending = this.column === column && !this.descending;
    this.column = column;
    this.heads.forEach((head, i) => head.setAttribute("aria-sort", i !== column ? "none" : this.descending ? "descending" : "ascending"));
    this.update();
  }

  rows() {
    const words = this.text.toLowerCase().split(/\s+/).filter(Boolean);
    const kept = this.section.rows.filter((row) => {
      const text = row.join(" ").toLowerCase();
      return words.every((word) => text.includes(word)) && (!this.chosen || row[this.verdicts] === this.chosen);
    });
    if (this.column >= 0) kept.sort((a, b) => compareCells(a[this.column], b[this.column]) * (this.descending ? -1 : 1));
    return kept;
  }

  update() {
    const rows = this.rows();
    this.body.replaceChildren(...rows.map((row) => element("tr", {}, row.map((value, i) => cell(value, this.section.columns[i].kind)))));
    this.count.textContent = rows.length === this.section.rows.length ? `${rows.length} rows` : `${rows.length} of ${this.section.rows.length} rows`;
  }

  verdictChoice() {
    const words = [...new Set(this.section.rows.map((row) => row[this.verdicts]))];
    if (this.verdicts < 0 || words.length < 2) return null;
    return labelled("show", choice(["all", ...words], (i) => {
      this.chosen = i ? words[i - 1] : "";
      this.update();
    }));
  }

  show() {
    this.update();
    const filter = element("input", { type: "search", placeholder: "words to keep", oninput: () => ((this.text = filter.value), this.update()) });
    const controls = element("div", { class: "controls" }, labelled("filter", filter), this.verdictChoice(), this.count);
    const table = element("table", {}, element("thead", {}, element("tr", {}, this.heads)), this.body);
    const frame = element("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": `${this.section.title}, table` }, table);
    return this.section.rows.length > 6 ? [controls, frame] : [frame];
  }
}

SECTIONS.table = (section) => (section.rows.length ? new Table(section).show() : [element("p", { class: "quiet" }, "Nothing.")]);
SECTIONS.notes = (section) => section.paragraphs.map((text) => element("p", {}, text));

// ---- The frame

const THEMES = ["auto", "light", "dark"];

function remembered(name) {
  try {
    return localStorage.getItem(name);
  } catch {
    return null; // a browser may forbid it to files
  }
}

function themeButton() {
  let theme = THEMES.includes(remembered("tegument-theme")) ? remembered("tegument-theme") : "auto";
  const button = element("button", { type: "button", class: "plain" });
  const apply = () => {
    document.documentElement.dataset.theme = theme;
    button.textContent = `colours: ${theme}`;
  };
  button.addEventListener("click", () => {
    theme = THEMES[(THEMES.indexOf(theme) + 1) % THEMES.length];
    try {
      localStorage.setItem("tegument-theme", theme);
    } catch {
      // then it holds until the page is closed
    }
    apply();
  });
  apply();
  return button;
}

function sectionElement(section, i) {
  const title = element("h2", { id: `title-${i}` }, section.title);
  const note = section.note ? element("p", { class: "note" }, section.note) : null;
  return element("section", { id: `section-${i}`, "aria-labelledby": `title-${i}` }, title, note, SECTIONS[section.kind](section));
}

function show() {
  const data = JSON.parse(document.getElementById("data").textContent);
  const facts = data.facts.map(([name, value]) => element("div", {}, element("dt", {}, name), element("dd", {}, value)));
  const links = data.sections.map((section, i) => element("li", {}, element("a", { href: `#section-${i}` }, section.title)));
  document.body.append(
    element("a", { class: "skip", href: "#main" }, "to the results"),
    element("header", {}, element("div", { class: "bar" }, element("h1", {}, data.title), data.verdict ? verdictPill(data.verdict) : null,
      element("p", { class: "summary" }, data.summary), themeButton()), element("dl", { class: "facts" }, facts)),
    element("nav", { "aria-label": "sections" }, element("ol", {}, links)),
    element("main", { id: "main", tabindex: "-1" }, data.sections.map(sectionElement)),
    tip,
  );
  document.body.dataset.ready = "yes";
}
