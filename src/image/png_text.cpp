#include "src/image/png_text.h"

#include <algorithm>
#include <string>
#include <utility>

#include "src/image/png_chunks.h"

namespace strata::image {
namespace {

// libpng writes from front to end and never looks back.
class ChunkInserter final : public OIIO::Filesystem::IOProxy {
  public:
    ChunkInserter(OIIO::Filesystem::IOProxy& target, std::string chunks)
        : IOProxy(target.filename(), Write), target_(target), chunks_(std::move(chunks)) {}

    const char* proxytype() const override { return "strata-png-text"; }
    std::size_t size() const override { return target_.size(); }

    std::size_t write(const void* data, std::size_t count) override {
        const auto* bytes = static_cast<const char*>(data);
        const std::size_t before = std::min(count, kPngStart - std::min(kPngStart, written_));
        put(bytes, before);
        if (written_ + before >= kPngStart && !std::exchange(is_inserted_, true)) put(chunks_.data(), chunks_.size());
        put(bytes + before, count - before);
        written_ += count;
        m_pos = static_cast<std::int64_t>(written_);
        return count;
    }

  private:
    // What `target` cannot take it tells its owner.
    void put(const char* bytes, std::size_t count) {
        if (count > 0) target_.write(bytes, count);
    }

    OIIO::Filesystem::IOProxy& target_;
    std::string chunks_;
    std::size_t written_ = 0;  // by libpng
    bool is_inserted_ = false;
};

}  // namespace

std::unique_ptr<OIIO::Filesystem::IOProxy> add_utf8_text(OIIO::Filesystem::IOProxy& bytes, const Metadata& metadata) {
    std::string chunks;
    for (const auto& [name, value] : metadata.entries())
        if (needs_utf8_chunk(value)) chunks += utf8_text_chunk(name, value);
    if (chunks.empty()) return nullptr;
    return std::make_unique<ChunkInserter>(bytes, std::move(chunks));
}

}  // namespace strata::image
