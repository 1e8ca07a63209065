// Pictures of a folder: those that are there already are kept, the others rendered.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "src/image/encode.h"
#include "src/image/metadata.h"
#include "src/parallel/cancel.h"
#include "tools/job/ledger.h"
#include "tools/job/picture_job.h"

namespace strata::tools::job {

// A picture that is rendered, unless its file is there already.
struct FolderPicture : PictureJob {
    std::string file;          // name in the folder
    image::Metadata metadata;  // what makes a file this picture
    image::WriteOptions write;
};

struct FolderWork {
    std::filesystem::path folder;
    int threads = 0;  // 0 for as many as machine and container give
    bool quiet = false;
};

struct Outcome {
    std::size_t kept = 0, rendered = 0;
    std::size_t failed = 0;  // could not be written, as was told
    bool cancelled = false;

    // Whether all are there; tells what is missing and that the same command goes on.
    bool is_whole(std::size_t pictures, bool quiet) const;
};

// Each picture is written when it is finished, its cost put into the ledger, and written() called. Prints what is kept
// and what is to be done. A picture that cannot be written is told and does not keep the others from being rendered;
// two in a row end the work.
Outcome render_missing(const FolderWork& work, const std::vector<const FolderPicture*>& pictures, Ledger& ledger,
                       const std::function<void()>& written, const parallel::CancelToken& cancel);

}  // namespace strata::tools::job
