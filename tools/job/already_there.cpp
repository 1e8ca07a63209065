#include "tools/job/already_there.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "src/image/digest.h"
#include "src/image/image_error.h"
#include "src/image/read.h"
#include "src/scene/key_text.h"
#include "tools/cli/errors.h"
#include "tools/cli/standard_output.h"

namespace strata::tools::job {

namespace fs = std::filesystem;

namespace {

constexpr const char* kOtherBytes = "its bytes are not those that were written";

// A line of a printed scene without its comment.
std::string_view setting_of(std::string_view line) {
    line = line.substr(0, line.find(" #"));
    return line.substr(0, line.find_last_not_of(' ') + 1);
}

// The first line in which two texts differ.
std::string difference(std::string_view found, std::string_view expected) {
    while (!found.empty() && !expected.empty()) {
        const std::string_view a = found.substr(0, found.find('\n')), b = expected.substr(0, expected.find('\n'));
        if (a != b) return fmt::format("'{}', not '{}'", scene::excerpt(setting_of(a)), scene::excerpt(setting_of(b)));
        found.remove_prefix(std::min(found.size(), a.size() + 1));
        expected.remove_prefix(std::min(expected.size(), b.size() + 1));
    }
    return "longer or shorter";
}

// Empty where they are equal.
std::string difference(const image::Metadata& found, const image::Metadata& expected) {
    for (const auto& [name, value] : expected.entries()) {
        const auto text = found.find(name);
        if (!text) return fmt::format("it does not say its {}", name);
        if (*text != value) return fmt::format("its {} is {}", name, difference(*text, value));
    }
    for (const auto& [name, value] : found.entries()) {
        if (!expected.find(name)) return fmt::format("its {} is '{}'", name, scene::excerpt(setting_of(value)));
    }
    return "";
}

std::string difference(const image::PictureShape& found, const image::PictureShape& expected) {
    if (found == expected) return "";
    if (found.width() != expected.width() || found.height() != expected.height()) {
        return fmt::format("it has {}x{} pixels, not {}x{}", found.width(), found.height(), expected.width(),
                           expected.height());
    }
    return "it is another part of the frame";
}

std::string damage_of(image::Integrity integrity) {
    switch (integrity) {
        case image::Integrity::whole:
            break;
        case image::Integrity::damaged:
            return kOtherBytes;
        case image::Integrity::another_length:
            return "it is not as long as it was written";
        case image::Integrity::unknown:
            return "it carries no digest of its bytes";
    }
    return "";
}

Found judge(const image::PictureFacts& facts, const image::Metadata& expected, const image::PictureShape& shape) {
    const std::string damage = damage_of(facts.integrity);
    // What it says of itself counts only where that can be trusted.
    if (facts.integrity == image::Integrity::damaged) return {Presence::damaged, damage};
    for (const std::string& why : {difference(facts.metadata, expected), difference(facts.shape, shape)}) {
        if (!why.empty()) return {Presence::other, why};
    }
    if (!damage.empty()) return {Presence::damaged, damage};
    return {Presence::same, ""};
}

// Nothing to judge by content: no file, none with content, or nothing that could be read.
bool is_without_content(const fs::path& path, Found& found) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::not_found) {
        found = {};
    } else if (!fs::is_regular_file(status)) {
        found = {Presence::other, "it is no file"};
    } else if (fs::file_size(path, error) == 0 && !error) {
        found = {Presence::damaged, "it is empty"};
    } else {
        return false;
    }
    return true;
}

// Why a file cannot be read; the name that the message begins with is told by the caller.
std::string reason_of(const image::ImageError& error) {
    const std::string_view message = error.what(), name = "\": ";
    const std::size_t end = message.find(name);
    return std::string(end == message.npos ? message : message.substr(end + name.size()));
}

}  // namespace

Found find_picture(const fs::path& path, const image::Metadata& expected, const image::PictureShape& shape) {
    Found found;
    if (is_without_content(path, found)) return found;
    try {
        if (!image::is_picture(path)) return {Presence::other, "it is no picture"};
        return judge(image::read_facts(path), expected, shape);
    } catch (const image::ImageError& error) {
        return {Presence::damaged, reason_of(error)};
    }
}

Found find_file(const fs::path& path, std::string_view digest) {
    Found found;
    if (is_without_content(path, found)) return found;
    try {
        if (image::digest_of_file(path) == digest) return {Presence::same, ""};
    } catch (const image::ImageError& error) {
        return {Presence::damaged, reason_of(error)};
    }
    return {Presence::damaged, kOtherBytes};
}

bool is_kept(const fs::path& path, const image::Metadata& expected, const image::PictureShape& shape, IfOther other,
             bool quiet) {
    const Found found = find_picture(path, expected, shape);
    if (found.presence == Presence::damaged && !quiet) tell_damaged(path, found);
    if (found.presence == Presence::other && other == IfOther::refuse) {
        throw cli::UsageError(
            fmt::format("{} is there and is not the frame asked for: {}; allowed: --overwrite, or another -o",
                        path.string(), found.why));
    }
    return found.presence == Presence::same;
}

void tell_damaged(const fs::path& path, const Found& found) {
    cli::print_out(fmt::format("damaged  {}: {}; it is made again\n", path.string(), found.why));
}

}  // namespace strata::tools::job
