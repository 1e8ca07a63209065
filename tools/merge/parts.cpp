#include "tools/merge/parts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "src/image/digest.h"
#include "src/image/image_error.h"
#include "src/image/read.h"
#include "src/journal/identity.h"
#include "tools/cli/errors.h"
#include "tools/job/shard_text.h"

namespace strata::tools::merge {

namespace {

namespace fs = std::filesystem;

struct Found {
    fs::path path;
    film::Shard shard;
    image::Metadata whole;  // without what tells parts apart
    std::string digest;     // of the file
};

Found look_at(const std::string& file) {
    const image::PictureFacts facts = image::read_facts(file);
    const auto shard = facts.metadata.find(job::kShardKey);
    if (!shard) throw cli::UsageError(fmt::format("{}: it is no part of a picture: `render --shard` makes them", file));
    if (facts.integrity != image::Integrity::whole) {
        throw cli::UsageError(fmt::format("{}: it is damaged; render part {} again", file, *shard));
    }
    if (facts.metadata.find("strata:partial")) {
        throw cli::UsageError(fmt::format("{}: it is unfinished; render part {} to its end", file, *shard));
    }
    Found found{file, job::parse_shard(*shard), {}, image::digest_of_file(file)};
    for (const auto& [name, value] : facts.metadata.entries()) {
        if (name != job::kShardKey) found.whole.set(name, value);
    }
    return found;
}

journal::Identity identity_of(const Found& found) {
    journal::Identity identity;
    identity.set("shards", fmt::format("{}", found.shard.count));
    for (const auto& [name, value] : found.whole.entries()) {
        if (name == image::kSceneKey)
            identity.set_lines(value);
        else
            identity.set(name, value);
    }
    return identity;
}

void refuse_others(const Found& first, const Found& other) {
    const std::vector<std::string> lines = journal::differences(identity_of(first), identity_of(other));
    if (lines.empty()) return;
    throw cli::UsageError(fmt::format("{} and {} are no parts of one picture (there: the former, here: the latter): {}",
                                      first.path.string(), other.path.string(), fmt::join(lines, "; ")));
}

// "3, 7 to 9, 12".
std::string ranges(const std::vector<int>& numbers) {
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < numbers.size();) {
        std::size_t last = i;
        while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
        texts.push_back(last == i ? fmt::format("{}", numbers[i]) : fmt::format("{} to {}", numbers[i], numbers[last]));
        i = last + 1;
    }
    return fmt::format("{}", fmt::join(texts, ", "));
}

void refuse_gaps(const std::map<int, Found>& found, int count) {
    std::vector<int> missing;
    for (int number = 1; number <= count; ++number) {
        if (!found.contains(number)) missing.push_back(number);
    }
    if (missing.empty()) return;
    throw cli::UsageError(fmt::format("of {} parts {} {} missing: part {}", count, missing.size(),
                                      missing.size() == 1 ? "is" : "are", ranges(missing)));
}

}  // namespace

Parts find_parts(const std::vector<std::string>& files) {
    std::map<int, Found> by_number;
    const Found first = look_at(files.front());
    for (const std::string& file : files) {
        const Found found = look_at(file);
        refuse_others(first, found);
        const auto [there, is_new] = by_number.try_emplace(found.shard.number, found);
        if (is_new || there->second.digest == found.digest) continue;
        throw cli::UsageError(fmt::format("{} and {} are both part {}, and differ", there->second.path.string(), file,
                                          job::shard_text(found.shard)));
    }
    refuse_gaps(by_number, first.shard.count);
    Parts parts{{}, first.whole, first.path};
    for (const auto& [number, found] : by_number) parts.parts.push_back({found.path, found.shard});
    return parts;
}

}  // namespace strata::tools::merge
