// FNV-1a in 64 bits: tells a damaged or another file from the one that was written. Every changed byte changes the sum.
#pragma once

#include <cstdint>
#include <string_view>

namespace hamilcar::io {

class Checksum {
public:
    void add(std::string_view bytes) {
        constexpr std::uint64_t prime = 0x100000001b3;
        for (const char byte : bytes) value_ = (value_ ^ static_cast<unsigned char>(byte)) * prime;
    }
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xcbf29ce484222325;
};

}  // namespace hamilcar::io
