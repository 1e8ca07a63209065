// A journal of any bytes is read as far as its records are whole. By the first byte: a file, as a crash may leave it;
// or a record's payload, as another program may have written it.
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include "src/journal/file.h"
#include "src/journal/identity.h"
#include "src/journal/journal_error.h"
#include "src/journal/kept_pixels.h"
#include "src/journal/pixel_record.h"
#include "tests/fuzz/scratch_file.h"

namespace journal = strata::journal;

namespace {

void read_pixels(journal::Bytes bytes) {
    journal::PayloadReader payload(bytes);
    const journal::PixelHead head = journal::read_pixel_head(payload);
    journal::KeptPixels kept({{0, 0, 200, 200}, 64});
    if (kept.add({}, head.rects) && kept.pixels() > 200 * 200) std::abort();
    for (const journal::PixelPart& part : journal::read_pixel_parts(payload, head)) {
        if (part.samples.size() != head.pixels() * part.layout.pixel_bytes()) std::abort();
    }
}

void read_identity(journal::Bytes bytes) {
    journal::PayloadReader payload(bytes);
    const journal::Identity identity = journal::Identity::read(payload);
    journal::PayloadWriter written;
    identity.write(written);
    journal::PayloadReader again(written.bytes());
    if (!(journal::Identity::read(again) == identity)) std::abort();
    journal::Identity other;
    other.set("program", "another");
    journal::differences(identity, other);
}

void read_file(journal::Bytes bytes) {
    const strata::fuzz::ScratchFile scratch(bytes, ".journal");
    const auto file = journal::File::open(scratch.path());
    if (!file) return;
    for (const journal::RecordPlace& place : file->places()) {
        const auto payload = file->read(place);
        if (payload.size() != place.length) std::abort();
        try {
            place.type == 1 ? read_identity(payload) : read_pixels(payload);
        } catch (const journal::JournalError&) {
        }
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const journal::Bytes bytes{data + 1, size - 1};
    try {
        switch (data[0] % 3) {
            case 0:
                read_file(bytes);
                break;
            case 1:
                read_identity(bytes);
                break;
            default:
                read_pixels(bytes);
        }
    } catch (const journal::JournalError&) {
    }
    return 0;
}
