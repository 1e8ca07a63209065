#include <fmt/format.h>
#include <fmt/ranges.h>

#include <system_error>

#include "src/image/metadata.h"
#include "src/image/read.h"
#include "src/library/scene_data.h"
#include "src/library/translate.h"
#include "src/scene/builtin.h"
#include "src/scene/key_lookup.h"
#include "src/scene/key_text.h"
#include "src/scene/keys.h"
#include "src/scene/printer.h"
#include "src/scene/scene_text.h"
#include "src/scene/suggest.h"
#include "src/scene/toml_reader.h"
#include "src/scene/validate.h"

namespace strata {

namespace {

// A change goes to a copy, so that a refused one leaves no trace.
void assign(scene::Scene& scene, std::string_view name, std::string_view value) {
    scene::Scene changed = scene;
    const std::vector<scene::Section> sections = scene::describe(changed);
    const auto [section_name, key_name] = scene::key_path(name);
    const scene::Section* section = scene::find_section(sections, section_name);
    const scene::Key* key = section ? scene::find_key(*section, key_name) : nullptr;
    if (!key) throw Error(scene::unknown_key(sections, section_name, key_name));
    scene::assign_value(*key, value);
    scene = changed;
}

// Calls use(key) for the key of that name.
template <class Use>
auto with_key(const scene::Scene& scene, std::string_view name, const Use& use) {
    scene::Scene copy = scene;
    const std::vector<scene::Section> sections = scene::describe(copy);
    for (const scene::Section& section : sections) {
        for (const scene::Key& key : section.keys) {
            if (key.full_name() == name) return use(key);
        }
    }
    const auto [section_name, key_name] = scene::key_path(name);
    throw Error(scene::unknown_key(sections, section_name, key_name));
}

std::string picture_scene(const std::filesystem::path& file) {
    const auto text = image::read_metadata(file, image::kSceneKey);
    if (!text) throw Error(file.string() + ": this picture does not say how it was made: strata did not write it");
    if (image::read_facts(file).integrity == image::Integrity::damaged) {
        throw Error(file.string() + ": damaged: its bytes are not those that were written");
    }
    return *text;
}

}  // namespace

Scene::Scene() : data_(std::make_unique<Data>()) {}
Scene::~Scene() = default;
Scene::Scene(const Scene& other) : data_(std::make_unique<Data>(*other.data_)) {}
Scene& Scene::operator=(const Scene& other) {
    if (this != &other) data_ = std::make_unique<Data>(*other.data_);
    return *this;
}
Scene::Scene(Scene&& other) noexcept = default;
Scene& Scene::operator=(Scene&& other) noexcept = default;

const Scene::Data& data_of(const Scene& scene) { return *scene.data_; }

scene::Scene checked(const Scene& scene) {
    const Scene::Data& data = data_of(scene);
    scene::validate(data.scene, data.source);
    return data.scene;
}

std::vector<std::string> Scene::builtin_names() {
    std::vector<std::string> names;
    for (const scene::BuiltinScene& builtin : scene::builtin_scenes()) names.push_back(builtin.name);
    return names;
}

Scene Scene::builtin(std::string_view name) {
    if (const auto found = scene::find_builtin(name)) return parse(found->text, found->name);
    const std::vector<std::string> names = builtin_names();
    std::string message =
        fmt::format("{}: no built-in scene, allowed: {}", scene::excerpt(name), fmt::join(names, ", "));
    if (const auto near = scene::nearest(std::string(name), names))
        message += fmt::format(", did you mean '{}'?", *near);
    throw Error(message);
}

Scene Scene::load(const std::filesystem::path& file) {
    return translated([&] {
        if (image::is_picture(file)) return parse(picture_scene(file), file.string());
        return parse(scene::file_text(file.string()), file.string());
    });
}

Scene Scene::parse(std::string_view toml, std::string_view source) {
    return translated([&] {
        Scene made;
        made.data_->scene = scene::read_scene(toml, source);
        made.data_->source = source;
        return made;
    });
}

void Scene::set(std::string_view key, std::string_view value) {
    translated([&] { assign(data_->scene, key, value); });
}

void Scene::set(std::string_view key, const Vector& value) {
    set(key, std::string_view(fmt::format("[{}, {}, {}]", scene::number_text(value[0]), scene::number_text(value[1]),
                                          scene::number_text(value[2]))));
}

void Scene::set_number(std::string_view key, double value) { set(key, std::string_view(scene::number_text(value))); }

std::string Scene::get(std::string_view key) const { return with_key(data_->scene, key, scene::value_text); }

std::vector<Key> Scene::keys() const {
    scene::Scene copy = data_->scene;
    std::vector<Key> keys;
    for (const scene::Section& section : scene::describe(copy)) {
        for (const scene::Key& key : section.keys) {
            keys.push_back({key.full_name(), scene::value_text(key), scene::allowed_text(key), std::string(key.meaning),
                            key.matters});
        }
    }
    return keys;
}

std::string Scene::toml() const { return scene::print_scene(data_->scene, scene::PrintedKeys::all); }

void Scene::check() const {
    translated([&] { scene::validate(data_->scene, data_->source); });
}

int Scene::width() const { return data_->scene.film.width; }

int Scene::height() const { return data_->scene.film.height; }

}  // namespace strata
