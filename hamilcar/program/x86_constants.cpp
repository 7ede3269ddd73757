#if defined(__x86_64__)

#include "hamilcar/program/x86_constants.hpp"

#include <cstring>

namespace hamilcar::program::x86 {

namespace {

template <class Number>
void append(std::string& bytes, Number number) {
    char raw[sizeof number];
    std::memcpy(raw, &number, sizeof number);
    bytes.append(raw, sizeof number);
}

}  // namespace

asmjit::x86::Mem ConstantTable::numbers(std::span<const double> values, Kind kind) {
    std::string bytes;
    for (const double value : values) {
        target_.is_double() ? append(bytes, value) : append(bytes, static_cast<float>(value));
    }
    return operand(bytes, kind);
}

asmjit::x86::Mem ConstantTable::bits(std::uint64_t bits, Kind kind) {
    std::string bytes;
    target_.is_double() ? append(bytes, bits) : append(bytes, static_cast<std::uint32_t>(bits));
    return operand(bytes, kind == Kind::scalar ? Kind::xmm : kind);
}

asmjit::x86::Mem ConstantTable::operand(const std::string& number, Kind kind) {
    const auto number_bytes = static_cast<std::size_t>(target_.number_bytes());
    const auto register_bytes = static_cast<std::size_t>(target_.bytes(kind));
    const bool one = number.size() == number_bytes && register_bytes > number_bytes;
    if (one && target_.has_masks()) {
        const asmjit::x86::Mem spread = asmjit::x86::ptr(base, offset_of(number) - bias());
        switch (register_bytes / number_bytes) {
            case 2: return spread._1to2();
            case 4: return spread._1to4();
            case 8: return spread._1to8();
            default: return spread._1to16();
        }
    }
    std::string bytes = number;
    while (one && bytes.size() < register_bytes) bytes += number;
    bytes.resize(register_bytes);  // two singles take a whole register
    return asmjit::x86::ptr(base, offset_of(bytes) - bias());
}

int ConstantTable::offset_of(const std::string& bytes) {
    const auto [found, is_new] = offsets_.try_emplace(bytes, 0);
    if (is_new) {
        bytes_.resize((bytes_.size() + bytes.size() - 1) / bytes.size() * bytes.size());
        found->second = static_cast<int>(bytes_.size());
        bytes_ += bytes;
    }
    return found->second;
}

}  // namespace hamilcar::program::x86

#endif
