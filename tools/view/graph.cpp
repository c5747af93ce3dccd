#include "tools/view/graph.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace tegument::view {

namespace {

void noteOnce(std::vector<std::string>& list, const std::string& text) {
    if (std::ranges::find(list, text) == list.end()) list.push_back(text);
}

void noteArrow(std::vector<TargetArrow>& arrows, const std::string& from, const std::string& to, const std::string& pass) {
    auto found = std::ranges::find_if(arrows, [&](const TargetArrow& arrow) { return arrow.from == from && arrow.to == to; });
    if (found == arrows.end()) found = arrows.insert(arrows.end(), {.from = from, .to = to, .times = 0});
    noteOnce(found->passes, pass);
    ++found->times;
}

std::string spoken(const std::string& target) {
    return target.empty() ? "the picture" : target;
}

std::string arrowLine(const char* word, const std::string& other, const TargetArrow& arrow) {
    const std::string times = arrow.times > arrow.passes.size() ? fmt::format(", {} times", arrow.times) : std::string();
    return fmt::format("{} {} by {}{}\n", word, spoken(other), fmt::join(arrow.passes, ", "), times);
}

} // namespace

std::vector<TargetArrow> arrowsOf(const SessionFrame& frame) {
    std::vector<TargetArrow> arrows;
    for (const SessionPass& pass : frame.passes)
        for (const std::string& from : pass.reads)
            for (const std::string& to : pass.writes)
                noteArrow(arrows, from, to, pass.name);
    return arrows;
}

std::vector<std::string> inOrderOfFlow(const SessionFrame& frame) {
    std::vector<std::string> written;
    for (const SessionPass& pass : frame.passes)
        for (const auto* targets : {&pass.writes, &pass.targets})
            for (const std::string& target : *targets)
                if (!target.empty() && std::ranges::find(frame.targets, target) != frame.targets.end()) noteOnce(written, target);
    std::vector<std::string> order;
    for (const std::string& target : frame.targets)
        if (std::ranges::find(written, target) == written.end()) order.push_back(target);
    order.insert(order.end(), written.begin(), written.end());
    order.emplace_back();
    return order;
}

std::string arrowText(const std::vector<TargetArrow>& arrows, const std::string& target) {
    std::string text;
    for (const TargetArrow& arrow : arrows)
        if (arrow.to == target) text += arrowLine("from", arrow.from, arrow);
    for (const TargetArrow& arrow : arrows)
        if (arrow.from == target && arrow.to != target) text += arrowLine("for", arrow.to, arrow);
    return text;
}

} // namespace tegument::view
