// The program of libFuzzer; HAMILCAR_READER names what it runs (scripts/fuzz).
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "fuzz/readers.hpp"

namespace {

const hamilcar::fuzz::Reader* reader = nullptr;

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    const char* name = std::getenv("HAMILCAR_READER");
    for (const hamilcar::fuzz::Reader& one : hamilcar::fuzz::readers()) {
        if (name && one.name == name) reader = &one;
    }
    if (reader) return 0;
    std::fputs("fuzzer: HAMILCAR_READER must name a folder of tests/fuzz/corpus\n", stderr);
    std::exit(2);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    reader->run({reinterpret_cast<const char*>(data), size});
    return 0;
}
