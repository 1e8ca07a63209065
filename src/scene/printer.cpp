#include "src/scene/printer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "src/scene/key_text.h"
#include "src/scene/keys.h"
#include "src/scene/relief_keys.h"

namespace strata::scene {

namespace {

constexpr std::size_t kCommentColumn = 44;  // longer assignments do not push the others' comments to the right

struct Line {
    std::string assignment;
    std::string comment;
};

Line line_of(const Key& key, const Key& of_defaults) {
    return {.assignment = fmt::format("{} = {}", key.name, value_text(key)),
            .comment = fmt::format("{}; default {}: {}", allowed_text(key), value_text(of_defaults), key.meaning)};
}

std::string aligned(const std::vector<Line>& lines) {
    std::size_t column = 0;
    for (const Line& line : lines) {
        const std::size_t width = line.assignment.size() + 2;
        if (width <= kCommentColumn) column = std::max(column, width);
    }
    std::string text;
    for (const Line& line : lines) {
        const std::size_t width = std::max(column, line.assignment.size() + 2);
        text += line.comment.empty() ? line.assignment + '\n'
                                     : fmt::format("{:<{}}# {}\n", line.assignment, width, line.comment);
    }
    return text;
}

// Terms of a list have the same keys over and over: each is explained where it comes first. Pictures carry this text,
// and some files have room for 60,000 bytes of it.
class ToldOnce {
  public:
    void tell(std::vector<Line>& lines) {
        for (Line& line : lines) {
            const std::string_view name = std::string_view(line.assignment).substr(0, line.assignment.find(' '));
            if (!told_.emplace(name, line.comment).second) line.comment.clear();
        }
    }

  private:
    std::set<std::pair<std::string, std::string>> told_;
};

}  // namespace

std::string print_scene(const Scene& scene, PrintedKeys keys) {
    Scene copy = scene;
    Scene default_scene;
    for (const noise::ReliefTerm& term : scene.surface.relief) {
        default_scene.surface.relief.push_back(default_relief_term(term.node.index()));
    }
    default_scene.ground.resize(scene.ground.size());
    default_scene.clouds.resize(scene.clouds.size());
    const std::vector<Section> sections = describe(copy);
    const std::vector<Section> defaults = describe(default_scene);

    std::string text =
        "# After each key: what it allows, its unit, its default and its meaning; of [[terms]], where it comes first.\n";
    ToldOnce terms;
    for (std::size_t i = 0; i < sections.size(); ++i) {
        const Section& section = sections[i];
        std::vector<Line> lines;
        for (std::size_t j = 0; j < section.keys.size(); ++j) {
            const Key& key = section.keys[j];
            const Key& of_defaults = defaults[i].keys[j];
            const bool differs = value_text(key) != value_text(of_defaults);
            if (keys == PrintedKeys::all || key.matters || differs || section.is_term)
                lines.push_back(line_of(key, of_defaults));
        }
        if (lines.empty()) continue;
        const std::string heading = section.is_term
                                        ? fmt::format("[[{}]]", section.name.substr(0, section.name.find('.')))
                                        : fmt::format("[{}]", section.name);
        if (!section.name.empty()) text += fmt::format("\n{}  # {}\n", heading, section.meaning);
        if (section.is_term) terms.tell(lines);
        text += aligned(lines);
    }
    return text;
}

}  // namespace strata::scene
