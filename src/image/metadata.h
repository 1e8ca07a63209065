// Named texts that travel inside a picture file: how it was made.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace strata::image {

// The whole scene and all settings as TOML: what a picture is rendered again from.
inline constexpr std::string_view kSceneKey = "strata:scene";

// An ordered list. Values are kept as text in every file format, so that they come back exactly as they went in;
// numbers are written with as many digits as reproduce them. Nothing that changes from run to run (date, time, host,
// thread count) belongs here: equal renders are equal files.
// A name is "strata:" and up to 72 printable ASCII characters without a blank or '=': no file format and no library
// gives such a name a meaning of its own. A value holds no NUL.
class Metadata {
  public:
    using Entry = std::pair<std::string, std::string>;

    // Whether name and value keep the rules above.
    static bool allows(std::string_view name, std::string_view value);

    // Replaces an earlier value of the same name. Throws ImageError for a name or value outside the rules above.
    void set(std::string_view name, std::string_view value);
    void set(std::string_view name, const char* value) { set(name, std::string_view(value)); }
    void set(std::string_view name, std::int64_t value);
    void set(std::string_view name, std::uint64_t value);
    void set(std::string_view name, int value) { set(name, static_cast<std::int64_t>(value)); }
    void set(std::string_view name, double value);

    std::optional<std::string> find(std::string_view name) const;
    const std::vector<Entry>& entries() const { return entries_; }

  private:
    std::vector<Entry> entries_;
};

// All entries as one text, a line "name = value" each, with backslash and line ends escaped: for formats that carry one
// description only. unpack() skips lines of any other shape.
std::string pack(const Metadata& metadata);
Metadata unpack(std::string_view text);

}  // namespace strata::image
