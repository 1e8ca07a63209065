#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "src/image/output_file.h"
#include "src/image/text.h"
#include "src/scene/validate.h"
#include "tools/cli/command_line.h"
#include "tools/cli/errors.h"
#include "tools/cli/planned_files.h"
#include "tools/cli/shared_options.h"
#include "tools/cli/standard_output.h"
#include "tools/gallery/scales.h"
#include "tools/gallery/tiles.h"
#include "tools/gallery/wall.h"
#include "tools/report/folder.h"
#include "tools/report/json.h"

namespace strata::tools::gallery {

namespace {

namespace fs = std::filesystem;

struct Request {
    cli::SceneArgument scene;
    std::string only, seeds, key, scales;
    fs::path folder = "gallery";
    cli::Working working;
    bool has_scene = false;
};

struct Gallery {
    std::vector<Tile> tiles;
    std::string title, introduction;
    std::string wall, page, json;  // files
};

Gallery gallery_of(const Request& request) {
    Gallery gallery;
    if (!request.seeds.empty()) {
        gallery.tiles = tiles_of_variants(request.scene, request.key, animate::parse_frames(request.seeds, "--seeds"));
        const std::string name = gallery.tiles.front().name;
        gallery.title = fmt::format("Variants of {}", name);
        gallery.introduction = "The same scene by other numbers. The command makes the picture at its own size.";
        gallery.wall = name + "-variants.jpg";
        gallery.page = name + "-variants.html";
        gallery.json = name + "-variants.json";
        return gallery;
    }
    std::vector<std::string> names = gallery_scenes();
    if (!request.only.empty()) {
        const std::vector<std::string> all = names;
        names.clear();
        for (const std::size_t i : cli::parse_names("--only", "scene of the gallery", request.only, all))
            names.push_back(all[i]);
    }
    gallery.tiles = tiles_of_scenes(names, request.scene);
    gallery.title = "Strata: a gallery";
    gallery.introduction =
        "Scenes that come with the program. Each is a formula, without a mesh or a texture: a small picture, a large "
        "one and any part of it show the same place. A click on a picture opens the large one.";
    gallery.wall = "wall.jpg";
    gallery.page = "index.html";
    gallery.json = "gallery.json";
    return gallery;
}

// Small ones first: a wall is soon there.
std::vector<const job::FolderPicture*> pictures_of(const Gallery& gallery) {
    std::vector<const job::FolderPicture*> pictures;
    for (const Tile& tile : gallery.tiles) pictures.push_back(&tile.small);
    for (const Tile& tile : gallery.tiles)
        if (tile.large) pictures.push_back(&*tile.large);
    return pictures;
}

// As they are now, not as an earlier gallery left them.
bool are_small_ones_there(const Gallery& gallery, const job::Ledger& ledger) {
    return std::ranges::all_of(gallery.tiles, [&](const Tile& tile) {
        return job::find_cost(ledger, tile.small.file, tile.small.metadata).has_value();
    });
}

constexpr int kFirstWidth = 512;  // of the frame that --scales begins with

int scales_command(const Request& request) {
    const parallel::CancelToken& cancel = cli::cancel_by_signals();
    const bool quiet = request.working.quiet;
    const cli::LoadedScene loaded = request.scene.load();
    scene::Scene scene = loaded.scene;
    scene.film.height = std::max(1, kFirstWidth * scene.film.height / scene.film.width);
    scene.film.width = kFirstWidth;
    const film::Rect place = cli::parse_crop("--scales", request.scales, scene.film);
    image::check_fonts();
    report::make_folder(request.folder);
    const fs::path file = request.folder / (loaded.name + "-scales.jpg");
    image::check_replaceable(file);
    job::Batch batch(request.working.threads, quiet, cancel);
    const std::vector<Scale> scales = compare_scales(scene, place, {1, 4, 32}, batch);
    if (scales.empty()) return cli::exit_code_of(true);
    batch.clear_progress();
    const auto is_same = is_same_by_one_thread(scene, place, scales.back(), quiet, cancel);
    if (!is_same) return cli::exit_code_of(true);
    const std::string caption = fmt::format(
        "{}: pixels {} of a frame of {} × {}, and the same place in larger frames. In the second row the fine pixels "
        "are added up to the coarse ones, by weights that make their B-splines (m = 3) the wide one: what is left is "
        "sampling, hits' tolerance, and ground finer than a sample, which fades out. The place in the largest frame "
        "has {} bits by one thread.",
        scene.title, request.scales, scene.film.width, scene.film.height, *is_same ? "the same" : "OTHER");
    const bool is_written =
        cli::is_written(file, [&] { image::write_canvas(file, draw_scales(scales, scene, caption)); });
    for (const Scale& scale : scales) {
        if (quiet || scale.factor == 1) continue;
        cli::print_out(fmt::format("{} x {}: RMSE {:.3g} from the small picture, {:.3g} by sampling alone\n",
                                   scale.width, scale.height, scale.difference, scale.expected));
    }
    if (is_written && !quiet) cli::print_out(fmt::format("wrote    {}\n", file.string()));
    return cli::exit_code_of(is_written && *is_same);
}

void check_words(const Request& request) {
    if (!request.scales.empty()) {
        if (!request.seeds.empty()) throw cli::UsageError("--seeds: allowed without --scales");
        if (!request.only.empty()) throw cli::UsageError("--only: allowed without --scales");
    }
    if (request.seeds.empty() && request.scales.empty() && request.has_scene)
        throw cli::UsageError("SCENE: allowed with --seeds or --scales; --only chooses scenes of the gallery");
    if (request.seeds.empty() && !request.key.empty()) throw cli::UsageError("--key: allowed with --seeds");
    if (!request.seeds.empty() && !request.only.empty()) throw cli::UsageError("--only: allowed without --seeds");
}

int gallery_command(const Request& request) {
    check_words(request);
    if (!request.scales.empty()) return scales_command(request);
    const parallel::CancelToken& cancel = cli::cancel_by_signals();
    const Gallery gallery = gallery_of(request);
    const std::vector<const job::FolderPicture*> pictures = pictures_of(gallery);
    image::check_fonts();
    report::make_folder(request.folder);
    for (const job::FolderPicture* picture : pictures) image::check_writable(request.folder / picture->file);
    for (const std::string& file : {gallery.wall, gallery.page, gallery.json})
        image::check_replaceable(request.folder / file);

    const fs::path json = request.folder / gallery.json;
    job::Ledger ledger = job::ledger_of(json, request.working.quiet);
    bool all_written = true;
    const auto write = [&](const std::string& file, const auto& text) {
        all_written &=
            cli::is_written(request.folder / file, [&] { image::replace_file(request.folder / file, text()); });
    };
    const auto draw = [&] {
        all_written &= cli::is_written(request.folder / gallery.wall, [&] {
            image::write_canvas(request.folder / gallery.wall, draw_wall(request.folder, gallery.tiles, gallery.title));
        });
    };
    bool is_wall_there = false;
    const auto after_each = [&] {
        write(gallery.json, [&] { return report::text_of({{"costs", job::to_json(ledger)}}); });
        if (is_wall_there || !are_small_ones_there(gallery, ledger)) return;
        is_wall_there = true;
        draw();
    };
    const job::Outcome outcome = job::render_missing({request.folder, request.working.threads, request.working.quiet},
                                                     pictures, ledger, after_each, cancel);
    if (!outcome.is_whole(pictures.size(), request.working.quiet))
        return outcome.cancelled ? cli::exit_code_of(true) : cli::kExitRuntime;
    if (!is_wall_there) draw();
    write(gallery.page, [&] { return page_of(gallery.tiles, ledger, gallery.title, gallery.introduction); });
    if (all_written && !request.working.quiet) {
        cli::print_out(fmt::format("wrote    {}: {}, {} and {} pictures\n", request.folder.string(), gallery.page,
                                   gallery.wall, pictures.size()));
    }
    return cli::exit_code_of(all_written);
}

}  // namespace

void add_command(cli::Command& program) {
    cli::Command* command = program.add_subcommand("gallery", "Render the built-in landscapes, or variants of a scene");
    auto request = std::make_shared<Request>();
    request->scene.add_to(*command);
    command->add_option("--seeds", request->seeds, "K,K-L,...",
                        "Variants of SCENE instead: one for each number, such as 1-36, 400 at most");
    command->add_option("--key", request->key, "KEY",
                        "With --seeds: the key that gets the numbers, such as relief.crests.seed; default relief.seed, "
                        "which is added to the seeds of all relief terms, or, where there are none, surface.seed");
    command->add_option("--scales", request->scales, "X0,Y0,X1,Y1",
                        "SCENE at three sizes instead: these pixels of a frame 512 wide, and the same place in frames "
                        "of 2048 and 16384, with how far they are from one another");
    command->add_option("--only", request->only, "NAME,...", "The gallery of these scenes alone");
    command->add_option(
        "-o,--output", [request](const std::string& text) { request->folder = text; }, "FOLDER",
        "Folder to write to, made if it is not there; default gallery");
    cli::add_working(*command, request->working);
    cli::add_simd(*command);
    command->footer(
        "The folder gets NAME.jpg of 1920x1080 and NAME-small.jpg of each scene, wall.jpg, a wall of the small ones,\n"
        "and index.html, a page of all with their commands, settings and times; it needs nothing from elsewhere.\n"
        "With --seeds: SCENE-KEY-NUMBER.jpg, 400 pixels wide, SCENE-variants.jpg with the command under each, and\n"
        "SCENE-variants.html. With --scales: SCENE-scales.jpg. Pictures that are there already, whole and of the\n"
        "same settings, are kept with their times; others of their names are replaced. Options that stand for scene\n"
        "keys count for all pictures.\n"
        "  strata gallery --only alpenglow,ridges --size 960x540 -N 2\n"
        "  strata gallery alpenglow --seeds 1-36\n"
        "  strata gallery dunes --seeds 1-9 --key relief.dunes.seed\n"
        "  strata gallery alpenglow --scales 252,18,276,32\n"
        "Exit codes: 0 done, 1 failed on the way, 2 wrong command line or scene, 129, 130 or 143 interrupted.");
    command->action([request, command] {
        request->has_scene = command->count("SCENE") > 0;
        return gallery_command(*request);
    });
}

}  // namespace strata::tools::gallery
