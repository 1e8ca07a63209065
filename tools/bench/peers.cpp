#include "tools/bench/peers.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>

#include "src/image/image_error.h"
#include "src/scene/printer.h"
#include "tools/bench/own_folder.h"
#include "tools/bench/variants.h"
#include "tools/cli/installer.h"
#include "tools/cli/process.h"

namespace strata::tools::bench {

namespace {

namespace fs = std::filesystem;

constexpr const char* kPackages = "peers";  // a section of tools/setup/packages.txt

constexpr int kVertices = 2048;  // a side of the mesh
constexpr int kQuickVertices = 256;

// max |n| of a slope: base 1, and 8 octaves of 0.3 times 3.75; and what POV-Ray says that it found, rounded up.
constexpr double kGuaranteedGradient = 10.0;
constexpr double kLooseGradient = 3.0;

struct Size {
    int width, height;
};

void write_text(const fs::path& path, const std::string& text) {
    std::ofstream file(path, std::ios::binary);
    if (!(file << text) || !file.flush()) throw image::ImageError("cannot write to " + path.string());
}

const Case* case_of(const Plan& plan, const std::string& id) {
    const auto found = std::ranges::find_if(plan.cases, [&](const Case& what) { return what.id() == id; });
    return found == plan.cases.end() ? nullptr : &*found;
}

// As POV-Ray warns of it; 0 where it does not.
double gradient_found(const std::string& output) {
    static const std::regex pattern(R"(maximum\s+gradient\s+found\s+was\s+([0-9.]+[0-9]))");
    std::smatch found;
    return std::regex_search(output, found, pattern) ? std::stod(found[1].str()) : 0;
}

fs::path companion() { return own_folder() / "strata_bench_embree"; }

}  // namespace

void install_peers() {
    if (fs::exists(companion())) return;
    // The companion is built where Embree is there.
    if (cli::install_packages(kPackages)) cli::restart_rebuilt();
}

Peers::Peers(const Plan& plan) : plan_(plan) {
    find_programs();
    write_text(scratch_.path() / "scene.pov", povray_scene(hyperterrain().scene));
    const Case* const what = case_of(plan_, plan_.figures.peer_samples);
    write_text(scratch_.path() / "scene.toml", scene::print_scene(what->scene));
}

void Peers::find_programs() {
    try {
        povray_ = cli::find_program("povray", "povray", kPackages);
    } catch (const cli::ProcessError& error) {
        missing_.emplace_back(error.what());
    }
    if (fs::exists(companion())) {
        embree_ = companion();
    } else {
        missing_.emplace_back(
            "Embree was not there when strata was built: Debian has it in the package libembree-dev; tools/strata "
            "bench --peers installs it, if it may, and builds with it");
    }
}

PeerResult& Peers::result(const std::string& id, const std::string& what) {
    const auto found = std::ranges::find(results_, id, &PeerResult::id);
    if (found != results_.end()) return *found;
    return results_.emplace_back(PeerResult{.id = id, .what = what, .ns_a_ray = {}});
}

void Peers::measure_povray(const Povray& variant) {
    const Size size = plan_.settings.quick ? Size{96, 54} : Size{480, 270};
    const cli::ProgramRun run =
        cli::run_program(povray_, {"+I" + (scratch_.path() / "scene.pov").string(), "-F", "-D", "-A", "-V", "+WT1",
                                   fmt::format("+W{}", size.width), fmt::format("+H{}", size.height),
                                   fmt::format("Declare=Gradient={}", variant.max_gradient),
                                   fmt::format("Declare=Shadows={}", variant.shadows ? 1 : 0)});
    PeerResult& row =
        result(variant.id, fmt::format("isosurface, max_gradient {}{}; {}x{}, one ray a pixel", variant.max_gradient,
                                       variant.shadows ? ", shadows" : "", size.width, size.height));
    row.ns_a_ray.push_back(1e9 * povray_trace_seconds(run.output) / (1.0 * size.width * size.height));
    const double found = gradient_found(run.output);
    if (found > 0) row.facts = {{"greatest gradient that POV-Ray met", found}};
}

void Peers::measure_embree() {
    const Case& what = *case_of(plan_, plan_.figures.peer_samples);
    const int vertices = plan_.settings.quick ? kQuickVertices : kVertices;
    std::vector<std::string> words{(scratch_.path() / "scene.toml").string(), (scratch_.path() / "heights").string(),
                                   fmt::format("{}", vertices)};
    for (const film::Rect& w : what.subset.windows) {
        words.push_back(fmt::format("{},{},{},{}", w.x0, w.y0, w.x1, w.y1));
    }
    const cli::ProgramRun run = cli::run_program(embree_, words);
    const auto json = nlohmann::json::parse(run.output, nullptr, false);
    if (json.is_discarded()) throw cli::ProcessError("strata_bench_embree: not understood:\n" + run.output);
    const std::string mesh = fmt::format("mesh of {0}x{0} vertices, the rays of '{1}'", vertices, what.id());
    PeerResult& one = result(kEmbreeOne, mesh + ", coherent flag");
    one.ns_a_ray.push_back(json.at("one_ns").get<double>());
    one.facts = {{"seconds to build, all threads", json.at("build_s").get<double>()},
                 {"MB of Embree", json.at("memory_bytes").get<double>() / 1e6},
                 {"height error, rms", json.at("height_error_rms").get<double>()},
                 {"height error, greatest", json.at("height_error_max").get<double>()},
                 {"share of rays that agree with the surface to a pixel's width", json.at("same_share").get<double>()}};
    result(kEmbreeSixteen, mesh).ns_a_ray.push_back(json.at("sixteen_ns").get<double>());
}

bool Peers::measure_round(const parallel::CancelToken& cancel) {
    try {
        if (!embree_.empty()) measure_embree();
        for (const Povray& variant :
             {Povray{kPovrayGuaranteed, kGuaranteedGradient, false}, Povray{kPovrayLoose, kLooseGradient, false},
              Povray{kPovrayShadows, kGuaranteedGradient, true}}) {
            if (cancel.requested()) return false;
            if (!povray_.empty()) measure_povray(variant);
        }
    } catch (const cli::ProcessError&) {
        // The signal that asks us to end has ended it too.
        if (cancel.requested()) return false;
        throw;
    }
    return !cancel.requested();
}

void Peers::report(Results& results) const {
    results.peers = results_;
    results.missing_peers = missing_;
    for (PeerResult& peer : results.peers) {
        peer.ns_a_ray.resize(std::min(peer.ns_a_ray.size(), static_cast<std::size_t>(results.rounds)));
    }
    std::erase_if(results.peers, [](const PeerResult& peer) { return peer.ns_a_ray.empty(); });
}

}  // namespace strata::tools::bench
