// Every reader that is fuzzed, by the name of its folder in corpus/.
#pragma once

#include <span>
#include <string_view>

namespace hamilcar::fuzz {

struct Reader {
    std::string_view name;
    void (*run)(std::string_view bytes);  // throws where it does not come through
};

std::span<const Reader> readers();

}  // namespace hamilcar::fuzz
