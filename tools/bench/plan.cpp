#include "tools/bench/plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "src/parallel/processors.h"
#include "tools/bench/light_features.h"
#include "tools/bench/variants.h"
#include "tools/cli/command_line.h"
#include "tools/cli/errors.h"

namespace strata::tools::bench {

namespace {

struct FrameSize {
    int width, height;
};

constexpr SubsetLimits kUsual{1'000'000, 16};
constexpr SubsetLimits kQuick{300'000, 4};
// Each ray of the reference tracer is on its own: any pixels will do, and it takes 40 times as long.
constexpr int kReferenceBlock = 16;  // px
constexpr int kReferenceBlocks = 64;
constexpr std::uint64_t kReferenceSeed = 1;
constexpr std::int64_t kAll = std::int64_t{1} << 62;

class Planner {
  public:
    explicit Planner(const PlanSettings& settings) { plan_.settings = settings; }

    Plan plan();

  private:
    SubsetLimits limits() const {
        SubsetLimits limits = plan_.settings.quick ? kQuick : kUsual;
        if (plan_.settings.rays) limits = {*plan_.settings.rays, 1};
        if (plan_.settings.whole) limits.rays = kAll;
        return limits;
    }
    FrameSize table_size() const { return plan_.settings.quick ? FrameSize{480, 270} : FrameSize{1920, 1080}; }
    int table_N() const { return plan_.settings.quick ? 4 : 10; }
    std::vector<FrameSize> sizes() const {
        return plan_.settings.quick ? std::vector<FrameSize>{{480, 270}}
                                    : std::vector<FrameSize>{{480, 270}, {1920, 1080}};
    }
    std::vector<int> Ns() const { return plan_.settings.quick ? std::vector{2, 4} : std::vector{2, 4, 10}; }

    // Its id.
    std::string add(const Case& wanted);
    std::string add(const Variant& variant, FrameSize size, int N);
    std::string add_reference(FrameSize size);
    std::string add_whole(const Variant& variant, FrameSize size, int N, int threads);

    void figures();
    void scenes();
    void rows();
    void octaves();
    void samples();
    void resolution();
    void threads();
    void reference();
    void light();
    void subset();

    Plan plan_;
};

Case sized(const Variant& variant, FrameSize size, int N) {
    Case made{variant.name, variant.scene, {}};
    made.scene.film.width = size.width;
    made.scene.film.height = size.height;
    made.scene.sampling.N = N;
    return made;
}

std::string Planner::add(const Case& wanted) {
    std::string id = wanted.id();
    const bool known = std::ranges::any_of(plan_.cases, [&](const Case& other) { return other.id() == id; });
    if (!known) plan_.cases.push_back(wanted);
    return id;
}

std::string Planner::add(const Variant& variant, FrameSize size, int N) {
    Case made = sized(variant, size, N);
    made.subset = subset_of(size.width, size.height, std::int64_t{1} * N * N, limits(), variant.block_seeds);
    return add(made);
}

std::string Planner::add_whole(const Variant& variant, FrameSize size, int N, int threads) {
    Case made = sized(variant, size, N);
    if (threads == 1) made.scene_name += ", in one piece";
    made.subset = {{{0, 0, size.width, size.height}}, 0};
    made.threads = threads;
    return add(made);
}

std::string Planner::add_reference(FrameSize size) {
    Case made = sized(hyperterrain(), size, 1);
    made.tracer = integrate::Tracer::reference;
    const int blocks = plan_.settings.rays ? 1 : plan_.settings.quick ? 12 : kReferenceBlocks;
    made.subset = blocks_of(size.width, size.height, kReferenceBlock, blocks, kReferenceSeed);
    return add(made);
}

void Planner::figures() {
    const FrameSize size = table_size();
    FigureCases& f = plan_.figures;
    f.main = add(hyperterrain(), size, table_N());
    f.few_samples = add(hyperterrain(), size, 2);
    f.peer_samples = add(hyperterrain(), size, 4);
    f.shadows = add(hyperterrain_shadows(), size, table_N());
    f.octaves = add(hyperterrain_octaves(16), size, table_N());
    f.planar = add(hyperterrain_planar(), size, table_N());
    f.spin_still = add(planet(), size, table_N());
    f.spin_moving = add(planet_turning(), size, table_N());
    f.camera_still = add(flyover(), size, table_N());
    f.camera_moving = add(flyover_moving(), size, table_N());
    reference();
    threads();
}

void Planner::scenes() {
    for (const Variant& variant :
         {hyperterrain(), hyperterrain_planar(), hyperterrain_shadows(), hyperterrain_octaves(16),
          hyperterrain_shared(), terrain(), isosurface(), planet(), planet_turning(), flyover_moving()}) {
        for (const FrameSize& size : sizes()) {
            for (const int N : Ns()) add(variant, size, N);
        }
    }
}

// A picture's mean hides where its time goes: rays to the horizon take ten times as long as those to the foreground,
// and those to the sky next to nothing. Blocks of one row of the grid each, spread over the frame's width; of a small
// frame the rows would be the same.
void Planner::rows() {
    struct Band {
        const char* name;
        double height;  // part of the frame's, from the top, that lies in the row
    };
    const int blocks = plan_.settings.quick ? 1 : 3;
    const FrameSize size{1920, 1080};
    for (const Band& band :
         {Band{"sky", 0.1}, Band{"horizon", 0.26}, Band{"far", 0.37}, Band{"middle", 0.5}, Band{"near", 0.8}}) {
        Case made = sized(hyperterrain(), size, table_N());
        made.scene_name += fmt::format(", {} rows", band.name);
        const int y0 = static_cast<int>(band.height * size.height) / kBlockUnit * kBlockUnit;
        const int columns = size.width / kBlockUnit;
        made.subset.block = kBlockUnit;
        for (int i = 0; i < blocks; ++i) {
            const int x0 = (2 * i + 1) * columns / (2 * blocks) * kBlockUnit;
            made.subset.windows.push_back({x0, y0, x0 + kBlockUnit, std::min(y0 + kBlockUnit, size.height)});
        }
        add(made);
    }
}

void Planner::octaves() {
    for (const int N : {2, table_N()}) {
        Curve curve{Section::octaves, "octaves", fmt::format("N = {}", N), {}};
        for (const int octaves : {4, 8, 16, 24}) {
            curve.points.push_back({1.0 * octaves, add(hyperterrain_octaves(octaves), table_size(), N)});
        }
        plan_.curves.push_back(curve);
    }
}

void Planner::samples() {
    for (const FrameSize& size : sizes()) {
        Curve curve{Section::samples, "N", fmt::format("{}×{}", size.width, size.height), {}};
        std::vector<int> counts{1, 2, 3, 4, 6, 10};
        if (plan_.settings.quick) counts = {1, 2, 4, 6};
        for (const int N : counts) curve.points.push_back({1.0 * N, add(hyperterrain(), size, N)});
        plan_.curves.push_back(curve);
    }
}

void Planner::resolution() {
    std::vector<FrameSize> all{{240, 135}, {480, 270}, {960, 540}, {1920, 1080}, {3840, 2160}};
    if (plan_.settings.quick) all.resize(3);
    for (const int N : {2, 4}) {
        Curve curve{Section::resolution, "frame's width / px", fmt::format("N = {}", N), {}};
        for (const FrameSize& size : all) {
            curve.points.push_back({1.0 * size.width, add(hyperterrain(), size, N)});
        }
        plan_.curves.push_back(curve);
    }
}

// One piece, as a user renders it: the threads share a frame, not blocks.
void Planner::threads() {
    if (parallel::available_processors() < 2) return;
    const FrameSize size = plan_.settings.quick || plan_.settings.rays ? FrameSize{480, 270} : FrameSize{1920, 1080};
    FigureCases& f = plan_.figures;
    f.one_thread = add_whole(hyperterrain(), size, 2, 1);
    f.two_threads = add_whole(hyperterrain(), size, 2, 2);
}

void Planner::reference() {
    for (const FrameSize& size : sizes()) plan_.figures.reference = add_reference(size);
}

// Whole small frames: what a feature costs depends on all that is seen.
void Planner::light() {
    const FrameSize size = plan_.settings.quick ? FrameSize{160, 90} : FrameSize{480, 270};
    const auto add_frame = [&](const Variant& variant) {
        Case made = sized(variant, size, 2);
        made.subset = {{{0, 0, size.width, size.height}}, 0};
        return add(made);
    };
    for (const LightFeature& feature : light_features())
        plan_.light.push_back({feature.name, add_frame(feature.off), add_frame(feature.on)});
}

// At N = 2 whole frames are cheap: each scene once whole, and once in the blocks that larger N are measured in.
void Planner::subset() {
    const FrameSize size = table_size();
    const std::int64_t samples = std::int64_t{1} * table_N() * table_N();
    for (const Variant& variant : {hyperterrain(), hyperterrain_planar(), hyperterrain_shadows(),
                                   hyperterrain_octaves(16), terrain(), isosurface(), planet(), flyover()}) {
        Case part = sized(variant, size, 2);
        part.subset = subset_of(size.width, size.height, samples, limits(), variant.block_seeds);
        part.scene_name += ", in blocks";
        Case whole = sized(variant, size, 2);
        whole.scene_name += ", whole";
        whole.subset = {{{0, 0, size.width, size.height}}, 0};
        plan_.subset_pairs.push_back({add(part), add(whole)});
    }
}

Plan Planner::plan() {
    const std::vector<std::pair<Section, void (Planner::*)()>> makers{
        {Section::figures, &Planner::figures}, {Section::scenes, &Planner::scenes},
        {Section::rows, &Planner::rows},       {Section::octaves, &Planner::octaves},
        {Section::samples, &Planner::samples}, {Section::resolution, &Planner::resolution},
        {Section::threads, &Planner::threads}, {Section::reference, &Planner::reference},
        {Section::light, &Planner::light},     {Section::subset, &Planner::subset}};
    for (const auto& [section, make] : makers) {
        if (plan_.has(section)) (this->*make)();
    }
    // What the peers are held against is measured in turns with them.
    if (plan_.has(Section::peers)) {
        plan_.figures.main = add(hyperterrain(), table_size(), table_N());
        plan_.figures.peer_samples = add(hyperterrain(), table_size(), 4);
    }
    return std::move(plan_);
}

}  // namespace

const std::vector<SectionName>& section_names() {
    static const std::vector<SectionName> names{
        {Section::figures, "figures", "what the target figures are taken from", true},
        {Section::scenes, "scenes", "every scene, size and N", true},
        {Section::rows, "rows", "hyperterrain by rows of the frame, from the sky to the foreground", true},
        {Section::octaves, "octaves", "cost against octaves: 4, 8, 16, 24", true},
        {Section::samples, "samples", "cost against N", true},
        {Section::resolution, "resolution", "cost against the frame's width", true},
        {Section::threads, "threads", "two threads against one", true},
        {Section::reference, "reference", "the reference tracer", true},
        {Section::light, "light", "each part of a still's light, off and on", true},
        {Section::subset, "subset", "the measured part of the frame against all of it", false},
        {Section::peers, "peers", "POV-Ray and Embree", false},
        {Section::memory, "memory", "memory of whole renders, up to 16384x16384", false}};
    return names;
}

std::vector<Section> parse_sections(const std::string& text) {
    std::vector<std::string> known;
    for (const SectionName& name : section_names()) known.emplace_back(name.name);
    std::vector<Section> sections;
    for (const std::size_t i : cli::parse_names("--only", "section", text, known)) {
        const Section section = section_names()[i].section;
        if (std::ranges::find(sections, section) != sections.end()) {
            throw cli::UsageError(fmt::format("--only: '{}' is named twice", known[i]));
        }
        sections.push_back(section);
    }
    return sections;
}

bool Plan::has(Section section) const {
    return std::ranges::find(settings.sections, section) != settings.sections.end();
}

Plan make_plan(const PlanSettings& settings) { return Planner(settings).plan(); }

}  // namespace strata::tools::bench
