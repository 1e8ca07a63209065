// The picture files of a render, all written at once: strip by strip as they come.
#pragma once

#include <filesystem>
#include <list>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "src/film/film.h"
#include "src/image/metadata.h"
#include "src/image/output_file.h"
#include "src/image/picture_stream.h"
#include "tools/job/cost_picture.h"
#include "tools/job/still_journal.h"
#include "tools/render/job.h"

namespace strata::tools::render {

// A file that cannot be written is told on standard error and given up; the others go on.
class PictureOutputs {
  public:
    // Begins all files of the job, which stays where it is: hidden until they are whole. For before the first ray.
    // Throws ImageError when one cannot be begun.
    explicit PictureOutputs(const Job& job);

    // Their heads, once what they are to say is known: before the first ray, where one that fails is an error of all,
    // or when all passes are done and each fails alone.
    void begin(const image::Metadata& metadata);
    void begin_late(const image::Metadata& metadata);

    // From now on strips come by way of this journal, or null.
    void use(job::StillJournal* journal) { journal_ = journal; }

    // Of files that are not in place, where they are hidden beside it.
    const std::vector<std::filesystem::path>& hidden_files() const { return hidden_files_; }

    // The next image::kStripRows rows, or those that are left.
    void write(const film::Film& strip);

    // All rows of a film of the job's window.
    void write_whole(const film::Film& film);

    // Whether there is still a file to be written.
    bool any() const;

    // Puts the files in place, and the pictures of AOVs. False if one of them, now or earlier, could not be written.
    bool finish();

    // As NAME.partial.EXT, with other metadata.
    bool finish_partial(const image::Metadata& metadata);

  private:
    struct Output {
        std::filesystem::path path;
        std::optional<integrate::ChannelSet::Entry> layer;  // empty: the picture
        std::unique_ptr<image::OutputFile> file;            // until it has a head
        std::optional<image::PictureStream> stream;         // empty after that: given up
    };

    struct Costs {
        Costs(const Job& job, const integrate::ChannelSet::Entry& aov)
            : picture(aov, job.picture.window), file(aov_path(job, *aov.channel)) {}

        job::CostPicture picture;
        image::OutputFile file;
    };

    void note_hidden(const image::OutputFile& file);
    void begin(Output& output, const image::Metadata& metadata);
    template <class Action>
    void for_each(const Action& action);
    void write_rows(std::span<const glm::vec3> pixels, std::span<const float> extra);
    bool write_costs();
    bool write_partial_costs(const image::Metadata& metadata);
    bool all() const;
    void tell_written(const std::filesystem::path& path) const;

    const Job& job_;
    job::StillJournal* journal_ = nullptr;
    std::vector<std::filesystem::path> hidden_files_;
    std::list<Costs> costs_;
    std::vector<Output> outputs_;
};

}  // namespace strata::tools::render
