#include "hamilcar/io/grid_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "hamilcar/base/text.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/whole_file.hpp"

namespace hamilcar::io {

namespace {

// Far beyond any road but short of where arithmetic suffers [m].
constexpr double max_height = 1e5, max_distance = 1e8, min_size = 1e-6;

// The words of a text, each with its line.
class Words {
public:
    Words(std::string_view text, std::string path) : text_(text), path_(std::move(path)) {}

    std::string_view next() {
        while (at_ < text_.size() && is_blank(text_[at_])) line_ += text_[at_++] == '\n';
        const std::size_t begin = at_;
        while (at_ < text_.size() && !is_blank(text_[at_])) ++at_;
        return text_.substr(begin, at_ - begin);
    }
    double number(const std::string& what) {
        const std::string_view word = next();
        const std::optional<double> value = number_in(word);
        if (!value)
            fail(fmt::format("expected {}, found {}", what, word.empty() ? "the end of the file" : quoted_text(word)));
        return *value;
    }
    std::size_t left() const { return text_.size() - at_; }
    [[noreturn]] void fail(const std::string& message) const {
        throw Error(ExitCode::bad_file, fmt::format("{}:{}: {}", path_, line_, message));
    }

private:
    static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
    std::string_view text_;
    std::string path_;
    std::size_t at_ = 0, line_ = 1;
};

std::size_t count(Words& words, const std::string& key, const std::map<std::string, double>& head) {
    const auto found = head.find(key);
    if (found == head.end()) words.fail("no '" + key + "' before the heights");
    if (!(found->second >= 2 && found->second <= 1e8 && found->second == std::floor(found->second))) {
        words.fail(fmt::format("key '{}' = {:g}: expected a whole number from 2 on", key, found->second));
    }
    return static_cast<std::size_t>(found->second);
}

}  // namespace

HeightGridDescription parse_grid(std::string_view text, const std::string& path) {
    constexpr std::array<std::string_view, 8> keys{"ncols",     "nrows",     "xllcorner", "yllcorner",
                                                   "xllcenter", "yllcenter", "cellsize",  "nodata_value"};
    Words words(text, path);
    std::map<std::string, double> head;
    Words heights = words;
    for (;;) {
        const std::string key = lower_case(words.next());
        if (std::ranges::find(keys, key) == keys.end()) break;
        if (head.contains(key)) words.fail("key '" + key + "' a second time");
        head[key] = words.number("a number after '" + key + "'");
        heights = words;
    }
    HeightGridDescription grid;
    grid.columns = count(words, "ncols", head), grid.rows = count(words, "nrows", head);
    const double size = head.contains("cellsize") ? head["cellsize"] : 0;
    if (!(size > 0)) words.fail("expected a positive 'cellsize' [m] before the heights");
    if (!(size >= min_size && size <= max_distance)) {
        words.fail(fmt::format("key 'cellsize' = {:g}: expected {:g} to {:g} m", size, min_size, max_distance));
    }
    grid.spacing_x = grid.spacing_y = size;
    const auto corner = [&](const std::string& axis) {
        if (head.contains(axis + "llcenter")) return head[axis + "llcenter"];
        return (head.contains(axis + "llcorner") ? head[axis + "llcorner"] : 0) + size / 2;
    };
    grid.x = corner("x"), grid.y = corner("y");
    if (!(std::abs(grid.x) <= max_distance && std::abs(grid.y) <= max_distance)) {
        words.fail(fmt::format("expected a corner within {:g} m of the origin", max_distance));
    }
    if (grid.columns > heights.left() / grid.rows) {
        heights.fail(fmt::format("{} columns and {} rows of heights do not fit into what is left of the file",
                                 grid.columns, grid.rows));
    }
    grid.heights.resize(grid.rows * grid.columns);
    for (std::size_t row = grid.rows; row-- > 0;) {
        for (std::size_t column = 0; column < grid.columns; ++column) {
            const double height = heights.number("a height");
            if (head.contains("nodata_value") && height == head["nodata_value"]) {
                heights.fail("a height is missing (NODATA_value); expected a grid without gaps");
            }
            if (!(std::abs(height) <= max_height))
                heights.fail(fmt::format("expected heights of {:g} m at most", max_height));
            grid.heights[row * grid.columns + column] = height;
        }
    }
    if (const auto more = heights.next(); !more.empty()) heights.fail("more heights than columns times rows");
    return grid;
}

HeightGridDescription read_grid(const std::string& path) {
    return parse_grid(read_whole_file(path, FileLimit::road), path);
}

}  // namespace hamilcar::io
