#include "tools/figures/record.h"

#include <fstream>

#include "src/image/digest.h"
#include "src/image/output_file.h"
#include "tools/job/already_there.h"

namespace strata::tools::figures {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* kDigests = "digests";

// Nothing for what is no record, an empty object for an emptied one.
ordered_json read_record(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    ordered_json record = ordered_json::parse(file, nullptr, /*allow_exceptions=*/false);
    if (record.is_object() && record.empty()) return record;
    return record.is_object() && record.contains(kDigests) && record[kDigests].is_object() ? record : ordered_json();
}

// What is wrong with a file is told; that there is none goes without saying.
bool has_its_bytes(const fs::path& file, const ordered_json& digest, bool quiet) {
    const job::Found found = job::find_file(file, digest.is_string() ? digest.get<std::string>() : "");
    if (found.presence == job::Presence::damaged && !quiet) job::tell_damaged(file, found);
    return found.presence == job::Presence::same;
}

}  // namespace

void write_record(const fs::path& path, ordered_json record, const std::vector<std::string>& files) {
    for (const std::string& file : files) record[kDigests][file] = image::digest_of_file(path.parent_path() / file);
    const std::string text = record.dump() + "\n";
    image::replace_file(path, text);
}

void empty_record(const fs::path& path) {
    std::error_code error;
    if (fs::exists(path, error)) image::replace_file(path, "{}\n");
}

bool is_made(const fs::path& path, const ordered_json& record, const std::vector<std::string>& files, bool quiet) {
    std::error_code error;
    if (!fs::exists(path, error)) return false;
    ordered_json found = read_record(path);
    if (found.is_null()) {
        if (!quiet) job::tell_damaged(path, {job::Presence::damaged, "it is no record"});
        return false;
    }
    if (found.empty()) return false;
    const ordered_json digests = found[kDigests];
    found.erase(kDigests);
    if (found != record) return false;
    bool all = true;
    for (const std::string& file : files) {
        const ordered_json digest = digests.contains(file) ? digests[file] : ordered_json();
        all = has_its_bytes(path.parent_path() / file, digest, quiet) && all;
    }
    return all;
}

}  // namespace strata::tools::figures
