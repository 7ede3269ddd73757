// Where the keys of a description stand in the files that it was read from, so that a mistake found later is reported there.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace hamilcar {

struct Place {
    std::shared_ptr<const std::string> file;
    std::size_t line = 1, column = 1;  // line 0: typed, in no file
};

// Keys are dotted; an entry of a list goes by its name, or by its number from 0 on: "axle[front].spring", "road.wave[0]".
struct Places {
    std::string file;  // that was asked for; keys may stand in one that it starts from
    std::map<std::string, Place, std::less<>> keys;

    // "file:line:column" of the deepest part of a key that is there; the file alone where none is.
    std::string of(std::string_view key) const {
        for (;;) {
            const auto found = keys.find(key);
            if (found != keys.end()) {
                const Place& place = found->second;
                if (place.line == 0) return *place.file;
                return *place.file + ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
            }
            const std::size_t end = key.find_last_of(".[");
            if (end == std::string_view::npos) return file;
            key = key.substr(0, end);
        }
    }
};

// "place: " for the beginning of a message about a key, or about the file as a whole; empty for what comes from no file.
inline std::string at_key(const std::shared_ptr<const Places>& places, std::string_view key = {}) {
    return places ? places->of(key) + ": " : std::string();
}

}  // namespace hamilcar
