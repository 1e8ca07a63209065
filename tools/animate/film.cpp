#include "tools/animate/film.h"

#include <fmt/format.h>

#include <string>
#include <system_error>
#include <vector>

#include "src/image/format.h"
#include "tools/cli/process.h"
#include "tools/cli/temporary_folder.h"

namespace strata::tools::animate {

namespace fs = std::filesystem;

namespace {

using Words = std::vector<std::string>;

// Frames are full-range sRGB; players expect BT.709, limited range.
constexpr const char* kVideoFilter =
    "scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_int,format=yuv420p";

// 4:2:0 video has even sides: the edge of an odd one is there twice, which is not seen.
std::string even_sides(int width, int height) {
    const int right = width % 2, bottom = height % 2;
    if (right == 0 && bottom == 0) return {};
    return fmt::format("format=gbrp,pad={}:{},fillborders=right={}:bottom={}:mode=smear,", width + right,
                       height + bottom, right, bottom);
}

// One palette for all frames, so that still parts do not flicker.
constexpr const char* kGifFilter =
    "split[a][b];[a]palettegen=stats_mode=full[p];[b][p]paletteuse=dither=sierra2_4a:diff_mode=rectangle";

// Threads are fixed: encoders' output depends on their number.
const Words kColourTags{"-colorspace",  "bt709", "-color_primaries", "bt709", "-color_trc", "bt709",
                        "-color_range", "tv",    "-threads",         "4"};

Words codec(const fs::path& film, const FilmTiming& timing, int width, int height) {
    const std::string extension = image::extension_of(film);
    Words words;
    if (extension == ".gif") {
        const std::string last = fmt::format("{}", timing.last_delay_cs.value_or(0));
        return {"-filter_complex", kGifFilter, "-loop", "0", "-final_delay", last, "-f", "gif"};
    }
    const std::string filter = even_sides(width, height) + kVideoFilter;
    if (extension == ".webm") {
        words = {"-vf", filter,      "-c:v", "libvpx-vp9", "-crf", "24", "-b:v",
                 "0",   "-deadline", "good", "-cpu-used",  "2",    "-f", "webm"};
    } else {
        words = {"-vf",  filter, "-c:v",      "libx264",    "-preset", "slow",
                 "-crf", "18",   "-movflags", "+faststart", "-f",      "mp4"};
    }
    words.insert(words.begin(), kColourTags.begin(), kColourTags.end());
    return words;
}

// ffmpeg takes frames that are numbered without gaps: links to those that the film has, in a folder of their own.
class FramesInARow {
  public:
    FramesInARow(const FramePattern& frames, const std::vector<int>& numbers) {
        std::error_code error;
        for (std::size_t i = 0; i < numbers.size() && !error; ++i) {
            fs::create_symlink(fs::absolute(frames.path(numbers[i])), folder_.path() / fmt::format("{}.png", i), error);
        }
        if (!error) return;
        throw cli::ProcessError(fmt::format("no links in \"{}\": {}", folder_.path().string(), error.message()));
    }

    std::string ffmpeg_pattern() const {
        std::string pattern = "file:";
        for (const char c : folder_.path().string()) pattern += c == '%' ? std::string("%%") : std::string(1, c);
        return pattern + "/%d.png";
    }

  private:
    cli::TemporaryFolder folder_{"film"};
};

}  // namespace

bool is_film(const fs::path& path) {
    const std::string extension = image::extension_of(path);
    return extension == ".mp4" || extension == ".webm" || extension == ".gif";
}

void encode_film(const fs::path& film, const image::ScratchFile& file, const FramePattern& frames,
                 const FilmTiming& timing, int width, int height) {
    const fs::path ffmpeg = cli::find_program("ffmpeg", "ffmpeg", "video");
    const FramesInARow in_a_row(frames, timing.frames);
    Words words{"-nostdin",
                "-hide_banner",
                "-loglevel",
                "error",
                "-y",
                "-fflags",
                "+bitexact",
                "-framerate",
                timing.rate.text(),
                "-start_number",
                "0",
                "-pattern_type",
                "sequence",
                "-i",
                in_a_row.ffmpeg_pattern(),
                "-frames:v",
                fmt::format("{}", timing.frames.size()),
                "-map_metadata",
                "-1",
                "-fflags",
                "+bitexact",
                "-flags:v",
                "+bitexact"};
    const Words chosen = codec(film, timing, width, height);
    words.insert(words.end(), chosen.begin(), chosen.end());
    words.push_back("file:" + file.path().string());
    cli::run_program(ffmpeg, words);
}

}  // namespace strata::tools::animate
