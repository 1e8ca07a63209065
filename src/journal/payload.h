// Numbers, texts and arrays put into a record's payload, and taken out again.
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "src/journal/journal_error.h"
#include "src/journal/record.h"

namespace strata::journal {

template <class T>
concept Plain = std::is_trivially_copyable_v<T>;

class PayloadWriter {
  public:
    template <Plain T>
    void put(const T& value) {
        put_bytes({reinterpret_cast<const unsigned char*>(&value), sizeof value});
    }

    // With its length in front.
    void put_text(std::string_view text) {
        put<std::uint64_t>(text.size());
        put_bytes({reinterpret_cast<const unsigned char*>(text.data()), text.size()});
    }

    void put_bytes(Bytes bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }

    Bytes bytes() const { return bytes_; }

  private:
    std::vector<unsigned char> bytes_;
};

// Throws JournalError where fewer bytes are left than are taken: a program of another version wrote them.
class PayloadReader {
  public:
    explicit PayloadReader(Bytes bytes) : left_(bytes) {}

    template <Plain T>
    T take() {
        T value;
        std::memcpy(&value, take_bytes(sizeof value).data(), sizeof value);
        return value;
    }

    std::string take_text() {
        const Bytes bytes = take_bytes(take<std::uint64_t>());
        return {bytes.begin(), bytes.end()};
    }

    Bytes take_bytes(std::uint64_t count) {
        if (count > left_.size()) throw JournalError("a record of the journal is shorter than what it should hold");
        const Bytes taken = left_.first(count);
        left_ = left_.subspan(count);
        return taken;
    }

    bool is_empty() const { return left_.empty(); }

  private:
    Bytes left_;
};

}  // namespace strata::journal
