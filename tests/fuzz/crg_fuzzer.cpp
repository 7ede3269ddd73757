#include <cstddef>
#include <cstdint>

#include "fuzz/targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    hamilcar::fuzz::run_crg({reinterpret_cast<const char*>(data), size});
    return 0;
}
