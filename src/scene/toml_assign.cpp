#include "src/scene/toml_assign.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "src/scene/key_lookup.h"
#include "src/scene/key_text.h"
#include "src/scene/suggest.h"

namespace strata::scene {

namespace {

std::string_view type_name(const toml::node& node) {
    switch (node.type()) {
        case toml::node_type::table:
            return "a table";
        case toml::node_type::array:
            return "an array";
        case toml::node_type::string:
            return "a string";
        case toml::node_type::integer:
            return "an integer";
        case toml::node_type::floating_point:
            return "a number with a point";
        case toml::node_type::boolean:
            return "true or false";
        default:
            return "a date or time";
    }
}

}  // namespace

Fault fault_at(const toml::source_position& at, std::string message) {
    return {at.line, at.column, std::move(message)};
}

std::string node_text(const toml::node& node) {
    if (const auto* value = node.as_integer()) return fmt::format("{}", value->get());
    if (const auto* value = node.as_floating_point()) return number_text(value->get());
    if (const auto* value = node.as_boolean()) return value->get() ? "true" : "false";
    if (const auto* value = node.as_string()) return fmt::format("\"{}\"", excerpt(value->get()));
    if (const auto* array = node.as_array()) return fmt::format("an array of {}", array->size());
    return std::string(type_name(node));
}

namespace {

Fault wrong_type(const Key& key, const toml::node& node) {
    const bool has_text = node.is_number() || node.is_string() || node.is_boolean();
    std::string problem = has_text ? fmt::format("wrong type, {}", type_name(node)) : "wrong type";
    if (std::holds_alternative<int*>(key.field) || std::holds_alternative<std::uint64_t*>(key.field)) {
        if (node.is_floating_point()) problem = "must be an integer, written without a point or exponent";
    }
    return fault_at(node.source().begin, complaint(key, problem, node_text(node)));
}

Fault bad_value(const Key& key, std::string_view problem, const toml::node& node) {
    return fault_at(node.source().begin, complaint(key, problem, node_text(node)));
}

MaybeFault read_camera_key(CameraKey& entry, const toml::table& table, std::size_t index);

// Stores a node into a key's field; one overload a type of field.
struct Assign {
    const Key& key;
    const toml::node& node;

    MaybeFault operator()(bool* field) const {
        const auto* value = node.as_boolean();
        if (!value) return wrong_type(key, node);
        *field = value->get();
        return std::nullopt;
    }

    MaybeFault operator()(int* field) const {
        const auto* value = node.as_integer();
        if (!value) return wrong_type(key, node);
        if (const auto problem = number_problem(key, static_cast<double>(value->get()))) {
            return bad_value(key, *problem, node);
        }
        *field = static_cast<int>(value->get());
        return std::nullopt;
    }

    MaybeFault operator()(std::uint64_t* field) const {
        const auto* value = node.as_integer();
        if (!value) return wrong_type(key, node);
        if (value->get() < 0) return bad_value(key, "out of range", node);
        *field = static_cast<std::uint64_t>(value->get());
        return std::nullopt;
    }

    MaybeFault operator()(double* field) const { return assign_number(*field, node); }

    MaybeFault operator()(Rate* field) const {
        if (const auto* text = node.as_string(); text && text->get().find('/') != std::string::npos) {
            const auto fraction = parse_fraction(text->get());
            if (!fraction) {
                const std::string problem = fmt::format("not a fraction of whole numbers up to {}", kMostOfFraction);
                return bad_value(key, problem, node);
            }
            if (const auto problem = number_problem(key, *fraction)) return bad_value(key, *problem, node);
            *field = *fraction;
            return std::nullopt;
        }
        double number = 0;
        if (auto fault = assign_number(number, node)) return fault;
        *field = number;
        return std::nullopt;
    }

    MaybeFault operator()(glm::dvec3* field) const {
        const auto* array = node.as_array();
        if (!array) return wrong_type(key, node);
        if (array->size() != 3) return bad_value(key, "not 3 numbers", node);
        for (int i = 0; i < 3; ++i) {
            if (auto fault = assign_number((*field)[i], *array->get(static_cast<std::size_t>(i)))) return fault;
        }
        if (const auto problem = field_problem(key)) {
            return fault_at(node.source().begin, complaint(key, *problem, value_text(key)));
        }
        return std::nullopt;
    }

    MaybeFault operator()(std::string* field) const {
        const auto* value = node.as_string();
        if (!value) return wrong_type(key, node);
        *field = value->get();
        return std::nullopt;
    }

    MaybeFault operator()(std::vector<std::string>* field) const {
        const auto* array = node.as_array();
        if (!array) return wrong_type(key, node);
        std::vector<std::string> names;
        for (const toml::node& name : *array) {
            const auto* value = name.as_string();
            if (!value) return wrong_type(key, name);
            names.push_back(value->get());
        }
        *field = std::move(names);
        return std::nullopt;
    }

    MaybeFault operator()(std::vector<double>* field) const {
        const auto* array = node.as_array();
        if (!array) return wrong_type(key, node);
        std::vector<double> numbers;
        for (const toml::node& number : *array) {
            if (auto fault = assign_number(numbers.emplace_back(), number)) return fault;
        }
        *field = std::move(numbers);
        return std::nullopt;
    }

    MaybeFault operator()(const Choice& choice) const {
        const auto* value = node.as_string();
        if (!value) return wrong_type(key, node);
        const auto found = std::find(choice.names.begin(), choice.names.end(), value->get());
        if (found == choice.names.end()) {
            Fault fault = bad_value(key, "unknown name", node);
            const std::vector<std::string> names(choice.names.begin(), choice.names.end());
            if (const auto near = nearest(value->get(), names)) {
                fault.message += fmt::format(", did you mean '{}'?", *near);
            }
            return fault;
        }
        choice.set(static_cast<std::size_t>(found - choice.names.begin()));
        return std::nullopt;
    }

    MaybeFault operator()(std::vector<CameraKey>* field) const {
        const auto* array = node.as_array();
        if (!array) return wrong_type(key, node);
        if (array->size() > kMostCameraKeys) return bad_value(key, "too many", node);
        std::vector<CameraKey> entries(array->size());
        for (std::size_t i = 0; i < entries.size(); ++i) {
            const auto* table = array->get(i)->as_table();
            if (!table) return wrong_type(key, *array->get(i));
            if (auto fault = read_camera_key(entries[i], *table, i)) return fault;
            if (const auto problem = time_problem(entries, i)) {
                return fault_at(table->get("time_s")->source().begin,
                                fmt::format("{}[{}].time_s: {} is {}, allowed: {}", key.full_name(), i,
                                            number_text(entries[i].time_s), *problem, allowed_text(key)));
            }
        }
        *field = std::move(entries);
        return std::nullopt;
    }

  private:
    // An integer or a float, of the key itself or of a component of its vector.
    MaybeFault assign_number(double& field, const toml::node& number) const {
        const auto value = number.is_number() ? number.value<double>() : std::nullopt;
        if (!value) return wrong_type(key, number);
        if (const auto problem = number_problem(key, *value)) return bad_value(key, *problem, number);
        field = *value;
        return std::nullopt;
    }
};

// What the table gives, and no more, becomes part of the entry.
MaybeFault read_camera_key(CameraKey& entry, const toml::table& table, std::size_t index) {
    Camera values;
    const std::vector<Section> sections{describe_camera_key(entry, values, index)};
    const Section& section = sections.front();
    for (auto&& [name, node] : table) {
        const Key* key = find_key(section, name.str());
        if (!key) return fault_at(name.source().begin, unknown_key(sections, section.name, name.str()));
        if (auto fault = assign_node(*key, node)) return fault;
    }
    if (!table.contains("time_s")) {
        return fault_at(table.source().begin, fmt::format("{}: has no time_s, allowed: {}", section.name,
                                                          "when it is, in seconds, and any of position, look_at, "
                                                          "fov_deg"));
    }
    if (table.contains("position")) entry.position = values.position;
    if (table.contains("look_at")) entry.look_at = values.look_at;
    if (table.contains("fov_deg")) entry.fov_deg = values.fov_deg;
    return std::nullopt;
}

}  // namespace

MaybeFault assign_node(const Key& key, const toml::node& node) { return std::visit(Assign{key, node}, key.field); }

}  // namespace strata::scene
