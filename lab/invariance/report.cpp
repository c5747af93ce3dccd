#include "lab/invariance/invariance.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>
#include <map>

namespace tegument {

namespace {

std::string figures(double relativeL2, double beyond) {
    const std::string l2 = relativeL2 == 0 ? "0" : fmt::format("{:.1e}", relativeL2);
    return beyond == 0 ? l2 : fmt::format("{} ({:.2g} %)", l2, 100 * beyond);
}

/// The largest of the cases of one technique and one column.
std::string entry(const std::vector<const InvarianceCell*>& cells) {
    double relativeL2 = 0;
    double beyond = 0;
    std::size_t drawn = 0;
    bool pass = true;
    for (const InvarianceCell* cell : cells) {
        pass = pass && cell->pass();
        if (cell->error) return "**error**";
        if (!cell->apart.empty()) continue;
        ++drawn;
        relativeL2 = std::max(relativeL2, cell->relativeL2);
        beyond = std::max(beyond, cell->beyond);
    }
    if (drawn == 0) return "-";
    return pass ? figures(relativeL2, beyond) : "**" + figures(relativeL2, beyond) + "**";
}

std::string effectAndTechnique(const InvarianceCell& cell) {
    const std::string effect = cell.effect.substr(0, cell.effect.rfind(".fx"));
    return effect == cell.technique ? effect : effect + " " + cell.technique;
}

void addOnce(std::vector<std::string>& list, const std::string& text) {
    if (std::ranges::find(list, text) == list.end()) list.push_back(text);
}

/// One line for each thing that is said: of which cases, and of which techniques.
void addNotes(std::string& text, const std::vector<InvarianceCell>& cells, const std::string& title,
              const std::function<std::string(const InvarianceCell&)>& saying) {
    struct Note {
        std::string said;
        std::vector<std::string> cases;
        std::vector<std::string> techniques;
    };
    std::vector<Note> notes;
    for (const InvarianceCell& cell : cells) {
        const std::string said = saying(cell);
        if (said.empty()) continue;
        auto note = std::ranges::find(notes, said, &Note::said);
        if (note == notes.end()) note = notes.insert(notes.end(), Note{.said = said});
        addOnce(note->cases, cell.name);
        addOnce(note->techniques, effectAndTechnique(cell));
    }
    if (notes.empty()) return;
    text += fmt::format("\n{}\n\n", title);
    for (const Note& note : notes)
        text += fmt::format("* {}: {}\n  ({})\n", fmt::join(note.cases, "; "), note.said, fmt::join(note.techniques, ", "));
}

std::string failure(const InvarianceCell& cell) {
    if (cell.pass()) return {};
    if (cell.error) return format(*cell.error);
    return fmt::format("{}, limit {:.0e} ({:.2g} %), largest {:.2g}", figures(cell.relativeL2, cell.beyond), cell.limit,
                       100 * cell.beyondLimit, cell.largest);
}

} // namespace

std::string invarianceMarkdown(const std::vector<InvarianceCell>& cells) {
    std::vector<std::string> columns;
    std::vector<std::string> rows;
    std::map<std::pair<std::string, std::string>, std::vector<const InvarianceCell*>> entries;
    for (const InvarianceCell& cell : cells) {
        const std::string row = effectAndTechnique(cell);
        if (std::ranges::find(rows, row) == rows.end()) rows.push_back(row);
        if (std::ranges::find(columns, cell.column) == columns.end()) columns.push_back(cell.column);
        entries[{row, cell.column}].push_back(&cell);
    }
    std::string text = "| technique |";
    std::string rule = "\n|---|";
    for (const std::string& column : columns) {
        text += fmt::format(" {} |", column);
        rule += "---|";
    }
    text += rule + "\n";
    for (const std::string& row : rows) {
        text += fmt::format("| {} |", row);
        for (const std::string& column : columns)
            text += fmt::format(" {} |", entry(entries[{row, column}]));
        text += "\n";
    }
    addNotes(text, cells, "Not asked, by definition of the technique:", [](const InvarianceCell& cell) { return cell.apart; });
    addNotes(text, cells, "Exceptions:", [](const InvarianceCell& cell) { return cell.excused; });
    addNotes(text, cells, "Beyond their limits:", failure);
    return text;
}

std::string invarianceJson(const std::vector<InvarianceCell>& cells) {
    auto list = nlohmann::ordered_json::array();
    for (const InvarianceCell& cell : cells) {
        nlohmann::ordered_json entry{{"effect", cell.effect}, {"technique", cell.technique}, {"column", cell.column}, {"case", cell.name}};
        if (cell.apart.empty() && !cell.error) {
            entry["rel_l2"] = cell.relativeL2;
            entry["beyond"] = cell.beyond;
            entry["largest"] = cell.largest;
        }
        entry["limit"] = cell.limit;
        entry["beyond_limit"] = cell.beyondLimit;
        if (!cell.apart.empty()) entry["apart"] = cell.apart;
        if (!cell.excused.empty()) entry["excused"] = cell.excused;
        if (cell.error) entry["error"] = format(*cell.error);
        entry["pass"] = cell.pass();
        list.push_back(std::move(entry));
    }
    return list.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

} // namespace tegument
