#include "tools/job/program_id.h"

#include <elf.h>
#include <fmt/format.h>
#include <link.h>

#include <cstddef>
#include <cstring>
#include <string_view>

namespace strata::tools::job {
namespace {

constexpr std::size_t padded(std::size_t size) { return (size + 3) / 4 * 4; }

constexpr char kGnu[] = "GNU";  // the owner of such notes, its last 0 included

// The description of the note NT_GNU_BUILD_ID among a segment's notes.
std::string build_id_in(const char* notes, std::size_t size) {
    for (std::size_t at = 0; at + sizeof(ElfW(Nhdr)) <= size;) {
        ElfW(Nhdr) note;
        std::memcpy(&note, notes + at, sizeof note);
        const std::size_t name = at + sizeof note, text = name + padded(note.n_namesz);
        if (text + note.n_descsz > size) break;
        if (note.n_type == NT_GNU_BUILD_ID &&
            std::string_view(notes + name, note.n_namesz) == std::string_view(kGnu, sizeof kGnu)) {
            std::string id;
            for (std::size_t i = 0; i < note.n_descsz; ++i) {
                id += fmt::format("{:02x}", static_cast<unsigned char>(notes[text + i]));
            }
            return id;
        }
        at = text + padded(note.n_descsz);
    }
    return "";
}

// The first object is the program itself.
int read_build_id(dl_phdr_info* object, std::size_t, void* id) {
    for (int i = 0; i < object->dlpi_phnum; ++i) {
        const ElfW(Phdr)& segment = object->dlpi_phdr[i];
        if (segment.p_type != PT_NOTE) continue;
        const auto* notes = reinterpret_cast<const char*>(object->dlpi_addr + segment.p_vaddr);
        std::string found = build_id_in(notes, segment.p_memsz);
        if (found.empty()) continue;
        *static_cast<std::string*>(id) = std::move(found);
        break;
    }
    return 1;
}

}  // namespace

std::string program_id() {
    std::string id;
    dl_iterate_phdr(read_build_id, &id);
    return id.empty() ? STRATA_VERSION : fmt::format("{}, build {}", STRATA_VERSION, id);
}

}  // namespace strata::tools::job
