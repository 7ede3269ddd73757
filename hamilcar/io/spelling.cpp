// Levenshtein distance over one row at a time.
#include "hamilcar/io/spelling.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "hamilcar/base/key_unit.hpp"
#include "hamilcar/base/text.hpp"

namespace hamilcar::io {

namespace {

std::size_t edits_between(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i + 1);
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (same_word(a.substr(i, 1), b.substr(j, 1)) ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
        }
    }
    return row.back();
}

}  // namespace

std::optional<std::string_view> nearest_word(std::string_view word, std::span<const std::string_view> candidates) {
    const std::string_view stem = unit_of_key(word).stem;
    std::size_t min = stem.size() <= 4 ? 2 : 3;  // accepted below this
    std::optional<std::string_view> nearest;
    for (const std::string_view candidate : candidates) {
        const std::size_t edits =
            std::min(edits_between(word, candidate), edits_between(stem, unit_of_key(candidate).stem));
        if (edits < min) min = edits, nearest = candidate;
    }
    return nearest;
}

std::string did_you_mean(std::string_view word, std::span<const std::string_view> candidates) {
    const auto near = nearest_word(word, candidates);
    return near ? "did you mean '" + std::string(*near) + "'?" : "";
}

std::string quoted_list(std::span<const std::string_view> words) {
    std::string list;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0) list += i + 1 == words.size() ? " or " : ", ";
        list += "'" + std::string(words[i]) + "'";
    }
    return list;
}

}  // namespace hamilcar::io
