#include <memory>

#include "tools/animate/make.h"
#include "tools/cli/errors.h"
#include "tools/cli/scene_argument.h"
#include "tools/cli/shared_options.h"
#include "tools/job/exr_format.h"

namespace strata::tools::animate {

void add_command(cli::Command& program) {
    cli::Command* command = program.add_subcommand("animate", "Render numbered frames and films");
    auto scene = std::make_shared<cli::SceneArgument>();
    auto request = std::make_shared<Request>();
    scene->add_to(*command);
    command->add_option("--frames", request->frames, "A-BxS,...",
                        "Frames first-last, both included, 0-100x2 for every second one, lists such as 0,2,7-9; "
                        "default one loop of a spin or wheel, or to the last camera key");
    command
        ->add_option("-o,--output", request->outputs, "FILE",
                     "NAME.png, .exr, .tif or .jpg: frames NAME.0001.png ... ('#'s choose where the number goes); "
                     "NAME.mp4, .webm or .gif: a film by ffmpeg (may be repeated); default SCENE.mp4")
        ->repeated();
    command->add_option("--columns", request->columns, "SETTINGS",
                        "Pictures side by side, their settings between ';', as \"none; N=4 m=4; shutter.open_s=0.02 "
                        "l=4 label='blurred'\"; \"scene\" is the scene as it is");
    command->add_option("--left", request->left, "SETTINGS",
                        "The left one of two pictures: \"none\" (the default), \"N=4 m=4\" ...");
    command->add_option("--right", request->right, "SETTINGS", "The right one; default the scene as it is");
    command->add_flag("--overwrite", request->overwrite, "Render and replace frames that are there");
    cli::add_threads(*command, request->threads);
    cli::add_tracer(*command, request->tracer);
    cli::add_simd(*command);
    command->add_option(
        "--format", [request](const std::string& text) { request->format = job::parse_exr_format(text); }, "NAME",
        "EXR channels: half (up to 65504) or float; default half");
    cli::add_quiet(*command, request->quiet);
    command->footer(
        "Frame k begins at k / shutter.fps seconds. What moves: camera.keys, surface.spin_deg_per_s, surface.drift,\n"
        "clouds.NAME.wind_m_s, the wheel. Motion blur: shutter.open_s > 0, by a B-spline of order --time-order, N * N "
        "samples in all.\n"
        "A frame that is there, whole and of the same settings, is kept; an empty, cut or damaged one is made again. "
        "One\n"
        "of other settings is refused before anything is rendered, unless --overwrite is given. Films alone keep their "
        "frames in FILE.frames until they are\n"
        "encoded (of two runs at once one has FILE-2.frames); interrupted, the same command goes on from them.\n"
        "A film of every second frame (--frames 0-100x2) shows half as many a second. A GIF shows up to 50 a second "
        "and\n"
        "leaves out the others; it plays as long as the frames take, to a hundredth of a second.\n"
        "The built-in scenes isosurface and wheel are compared side by side unless --columns says otherwise.\n"
        "  strata animate isosurface                           loops: no antialiasing | in space and time\n"
        "  strata animate planet --frames 0-99 -o 'out/planet.####.exr' -o planet.mp4 --set shutter.open_s=0.02\n"
        "  strata animate wheel --columns \"none; l=1; l=4\" --size 320x320 -o wheel.gif\n"
        "Exit codes: 0 done, 1 failed on the way, 2 wrong command line or scene, 129, 130 or 143 interrupted.");
    command->action([scene, request, command] {
        if (command->count("--frame") > 0) {
            throw cli::UsageError("--frame: allowed: --frames A-B, or --frames A for one");
        }
        const parallel::CancelToken& cancel = cli::cancel_by_signals();
        return make_animation(prepare_animation(scene->load(), *request), cancel);
    });
}

}  // namespace strata::tools::animate
