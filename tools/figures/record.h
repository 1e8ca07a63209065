// The record of a figure or film: one line of JSON beside its files, written last, with a digest of each of them.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace strata::tools::figures {

// The files are of the record's folder. Throws ImageError.
void write_record(const std::filesystem::path& path, nlohmann::ordered_json record,
                  const std::vector<std::string>& files);

// Empties a record that is there: without it the files count as unfinished. The file stays, and what its owner set.
// Throws ImageError.
void empty_record(const std::filesystem::path& path);

// Whether the record is there and says the same, and each of the files is there with the bytes that it was written
// with. Tells what is damaged unless quiet.
bool is_made(const std::filesystem::path& path, const nlohmann::ordered_json& record,
             const std::vector<std::string>& files, bool quiet);

}  // namespace strata::tools::figures
