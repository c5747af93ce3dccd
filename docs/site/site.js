"use strict";
// Search over the pages' words, and the sliders of the gallery. No request: the index is a script.
const found = document.getElementById("found");
const up = document.body.dataset.up;

function hits(words) {
    const rated = INDEX.map(page => {
        const text = page.text.toLowerCase(), title = page.title.toLowerCase();
        if (!words.every(word => text.includes(word))) return null;
        const rate = words.reduce((sum, word) => sum + Math.min(20, text.split(word).length - 1) + (title.includes(word) ? 100 : 0), 0);
        return { page, rate, at: text.indexOf(words[0]) };
    });
    return rated.filter(Boolean).sort((a, b) => b.rate - a.rate).slice(0, 12);
}

document.getElementById("search").addEventListener("input", event => {
    const words = event.target.value.toLowerCase().split(/\s+/).filter(Boolean);
    found.replaceChildren();
    found.hidden = words.length === 0;
    for (const { page, at } of words.length ? hits(words) : []) {
        const entry = document.createElement("li"), link = document.createElement("a"), text = document.createElement("div");
        link.href = up + "/" + page.url;
        link.textContent = page.title;
        text.textContent = page.text.slice(Math.max(0, at - 50), at + 110);
        entry.append(link, text);
        found.append(entry);
    }
    if (!found.hidden && !found.children.length) found.append(Object.assign(document.createElement("li"), { textContent: "nothing found" }));
});

for (const beside of document.querySelectorAll(".beside")) {
    const slider = beside.querySelector("input"), over = beside.querySelector(".over");
    slider.addEventListener("input", () => { over.style.clipPath = `inset(0 ${100 - slider.value}% 0 0)`; });
}
document.body.dataset.ready = "yes";
