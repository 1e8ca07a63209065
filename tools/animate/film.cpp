#include "tools/animate/film.h"

#include <fmt/format.h>
#include <unistd.h>

#include <string>
#include <system_error>
#include <vector>

#include "src/image/scratch_files.h"
#include "src/scene/key_text.h"
#include "tools/process.h"

namespace strata::tools {

namespace fs = std::filesystem;

namespace {

using Words = std::vector<std::string>;

// 4:2:0 video has even sides. Frames are full-range sRGB; players expect BT.709, limited range.
constexpr const char* kVideoFilter =
    "pad=ceil(iw/2)*2:ceil(ih/"
    "2)*2:color=white,scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_"
    "int,format=yuv420p";

// One palette for all frames, so that still parts do not flicker.
constexpr const char* kGifFilter =
    "split[a][b];[a]palettegen=stats_mode=full[p];[b][p]paletteuse=dither=sierra2_4a:diff_mode=rectangle";

// Threads are fixed: encoders' output depends on their number.
const Words kColourTags{"-colorspace",  "bt709", "-color_primaries", "bt709", "-color_trc", "bt709",
                        "-color_range", "tv",    "-threads",         "4"};

Words codec(const fs::path& film) {
    const std::string extension = film.extension().string();
    Words words;
    if (extension == ".gif") return {"-filter_complex", kGifFilter, "-loop", "0", "-f", "gif"};
    if (extension == ".webm") {
        words = {"-vf", kVideoFilter, "-c:v", "libvpx-vp9", "-crf", "24", "-b:v",
                 "0",   "-deadline",  "good", "-cpu-used",  "2",    "-f", "webm"};
    } else {
        words = {"-vf",  kVideoFilter, "-c:v",      "libx264",    "-preset", "slow",
                 "-crf", "18",         "-movflags", "+faststart", "-f",      "mp4"};
    }
    words.insert(words.begin(), kColourTags.begin(), kColourTags.end());
    return words;
}

// Beside the film and hidden; gone unless it was renamed.
class TemporaryFilm {
  public:
    explicit TemporaryFilm(const fs::path& film)
        : path_(film.parent_path() / fmt::format(".strata-film-{}{}", ::getpid(), film.extension().string())) {
        image::remember_scratch_file(path_.c_str());
    }
    ~TemporaryFilm() {
        std::error_code ignored;
        fs::remove(path_, ignored);
        image::forget_scratch_file(path_.c_str());
    }
    TemporaryFilm(const TemporaryFilm&) = delete;
    TemporaryFilm& operator=(const TemporaryFilm&) = delete;

    const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

}  // namespace

bool is_film(const fs::path& path) {
    const std::string extension = path.extension().string();
    return extension == ".mp4" || extension == ".webm" || extension == ".gif";
}

void encode_film(const fs::path& film, const FramePattern& frames, const FrameRange& range, double fps) {
    const fs::path ffmpeg = find_program("ffmpeg", "ffmpeg");
    const TemporaryFilm temporary(film);
    Words words{"-nostdin",
                "-hide_banner",
                "-loglevel",
                "error",
                "-y",
                "-fflags",
                "+bitexact",
                "-framerate",
                scene::number_text(fps),
                "-start_number",
                fmt::format("{}", range.first),
                "-i",
                frames.ffmpeg_pattern(),
                "-frames:v",
                fmt::format("{}", range.count()),
                "-map_metadata",
                "-1",
                "-fflags",
                "+bitexact",
                "-flags:v",
                "+bitexact"};
    const Words chosen = codec(film);
    words.insert(words.end(), chosen.begin(), chosen.end());
    words.push_back("file:" + temporary.path().string());
    run_program(ffmpeg, words);
    std::error_code error;
    fs::rename(temporary.path(), film, error);
    if (error) throw ProcessError(fmt::format("cannot write \"{}\": {}", film.string(), error.message()));
}

}  // namespace strata::tools
