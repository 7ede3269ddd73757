#include "hamilcar/io/crg_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "hamilcar/base/text.hpp"
#include "hamilcar/io/error.hpp"

namespace hamilcar::io::crg {

namespace {

constexpr std::size_t header_width = 72;  // of a header's line, what is beyond does not count

// Whether a line that begins with $ ends the section it is in: nothing but a remark follows.
bool ends_section(std::string_view line) {
    const std::string_view after = trimmed(line.substr(1));
    return after.empty() || after[0] == '!' || line[1] == ' ' || line[1] == '\t';
}

// What C's atof takes of a text, as OpenCRG's tools do: "1.5 m" is 1.5.
std::string leading_number(std::string text) {
    while (!text.empty() && !number_in(text)) text.pop_back();
    return std::string(trimmed(text));
}

}  // namespace

std::string plain(std::string_view text) {
    std::string out;
    for (const char c : lower_case(trimmed(text))) {
        const bool blank = c == ' ' || c == '\t', shown = c >= ' ' && c <= '~';
        if (blank && !out.empty() && out.back() == ' ') continue;
        out += blank ? ' ' : shown ? c : '?';
    }
    return out;
}

// Lines end with LF, CR LF or, from old machines, CR.
std::string_view Text::next_line() {
    const auto end = rest_.find_first_of("\r\n");
    const std::string_view line = rest_.substr(0, end);
    const std::size_t mark = end == std::string_view::npos ? 0 : rest_.substr(end).starts_with("\r\n") ? 2 : 1;
    rest_.remove_prefix(line.size() + mark);
    ++line_;
    return line;
}

Header::Header(Text& text, std::string name) : name_(std::move(name)) {
    read(text);
    if (definition_line_ == 0 && reference_.value.empty())
        fail(text.line(), "$kd_definition", "this section before the data");
    list_unknown();
}

void Header::fail(int line, const std::string& key, const std::string& expected) const {
    throw Error(ExitCode::bad_file, fmt::format("{}:{}: key {}: expected {}", name_, line, key.substr(0, 64), expected),
                key);
}

std::string Header::remark(int line, const std::string& key, const std::string& text) const {
    return fmt::format("{}:{}: key '{}' {}", name_, line, key.substr(0, 64), text);
}

void Header::read(Text& text) {
    std::string section;  // none: between sections
    text.skip(text.rest().size() - without_byte_order_mark(text.rest()).size());
    while (!text.rest().empty()) {
        const std::string_view whole = text.next_line(), line = whole.substr(0, header_width);
        if (line.starts_with('$')) {
            if (line.starts_with("$$")) {
                if (!section.empty())
                    fail(text.line(), "$" + section, "a line $ that ends this section before the data");
                return;
            }
            if (ends_section(line)) {
                section.clear();
                continue;
            }
            if (!section.empty() && section != "ct")
                fail(text.line(), "$" + section, "a line $ that ends this section");
            section = plain(line.substr(1, line.find_first_of(" \t!", 1) - 1));
            open_section(section, text.line());
        } else if (section == "road_crg_file") {
            const std::string_view part = trimmed(whole.substr(0, whole.find('!')));
            if (!part.starts_with('*')) reference_.value += part;
        } else if (!section.empty()) {
            read_line_of(section, line, text.line());
        }
    }
    if (reference_.value.empty()) fail(std::max(text.line(), 1), "$$$$", "the line that ends the header");
}

void Header::open_section(std::string_view name, int at) {
    if (name == "road_crg_file") {
        if (reference_.line > 0) fail(at, "$road_crg_file", "one such section");
        reference_.line = at;
    }
    if (name == "kd_definition") {
        if (definition_line_ > 0) fail(at, "$kd_definition", "one such section");
        definition_line_ = at;
    }
    if (name != road_section && name != options_section && name != modifiers_section) return;
    Section& section = sections_[std::string(name)];
    if (section.line > 0) {
        const bool adds = name == road_section;
        remarks_.push_back(remark(at, "$" + std::string(name),
                                  fmt::format("is there in line {} too: the later {}", section.line,
                                              adds ? "one adds to it" : "one counts alone")));
        if (!adds) section.keys.clear();
    }
    section.line = at;
}

void Header::read_line_of(const std::string& section, std::string_view line, int at) {
    line = trimmed(line.substr(0, line.find('!')));
    if (line.empty() || line[0] == '*') return;
    if (section == "kd_definition") return read_definition(line, at);
    const auto found = sections_.find(section);
    if (found == sections_.end()) return;  // a comment, a map projection, what somebody added
    const auto equal = line.find('=');
    const std::string key = plain(line.substr(0, equal));
    if (equal == std::string_view::npos) fail(at, key, "KEY = number");
    Entry& entry = found->second.keys[key];
    if (entry.line > 0)
        remarks_.push_back(remark(at, key, fmt::format("is in line {} too: the later one counts", entry.line)));
    entry = {plain(line.substr(equal + 1)), at};
    const std::string number = leading_number(entry.value);
    if (number.empty() || number == entry.value) return;
    remarks_.push_back(remark(at, key, fmt::format("= {} is read as {}", quoted_text(entry.value), number)));
    entry.value = number;
}

void Header::read_definition(std::string_view line, int at) {
    const std::string_view kind = line.substr(0, 2), what = line.substr(std::min<std::size_t>(2, line.size()));
    if (kind == "#:") {
        format_ = {plain(what), at};
    } else if (kind == "D:" || kind == "d:") {
        const auto comma = what.find(',');
        const std::string_view unit = comma == std::string_view::npos ? std::string_view() : what.substr(comma + 1);
        channels_.push_back({plain(what.substr(0, comma)), plain(unit.substr(0, unit.find(','))), at});
    } else if (kind == "U:" || kind == "u:") {
        u_channel_ = {plain(what), at};
    }
}

bool Header::has(const std::string& section, const std::string& key) const {
    const auto found = sections_.find(section);
    return found != sections_.end() && found->second.keys.contains(key);
}

int Header::line_of(const std::string& section, const std::string& key) const {
    return has(section, key) ? sections_.at(section).keys.at(key).line : definition_line_;
}

double Header::number(const std::string& section, const std::string& key, double fallback, double low,
                      double high) const {
    if (!has(section, key)) return fallback;
    const Entry& entry = sections_.at(section).keys.at(key);
    const std::optional<double> read = number_in(entry.value);
    if (!read || !(*read >= low && *read <= high))
        fail(entry.line, key, fmt::format("a number from {:g} to {:g}, not '{}'", low, high, entry.value));
    return *read;
}

std::optional<double> Header::maybe(const std::string& section, const std::string& key, double max) const {
    if (!has(section, key)) return std::nullopt;
    return number(section, key, 0, -max, max);
}

int Header::choice(const std::string& section, const std::string& key, int fallback, int max) const {
    const double read = number(section, key, fallback, 0, max);
    if (read != std::floor(read)) fail(line_of(section, key), key, fmt::format("a whole number from 0 to {}", max));
    return static_cast<int>(read);
}

// As OpenCRG's tools do; a misspelled key is not passed over in silence.
void Header::list_unknown() {
    struct Known {
        const std::string& section;
        std::vector<std::string_view> keys, beginnings;  // those of what has no bearing on the surface
    };
    const std::array<Known, 3> known{
        {{road_section,
          {"reference_line_start_u",     "reference_line_end_u",     "reference_line_increment",
           "long_section_v_right",       "long_section_v_left",      "long_section_v_increment",
           "reference_line_start_x",     "reference_line_start_y",   "reference_line_start_z",
           "reference_line_start_phi",   "reference_line_start_s",   "reference_line_start_b",
           "reference_line_end_x",       "reference_line_end_y",     "reference_line_end_z",
           "reference_line_end_phi",     "reference_line_end_s",     "reference_line_end_b",
           "reference_line_start_lon",   "reference_line_start_lat", "reference_line_start_alt",
           "reference_line_end_lon",     "reference_line_end_lat",   "reference_line_end_alt",
           "reference_line_continuation"},
          {"reference_line_offset_"}},
         {options_section,
          {"border_mode_u", "border_mode_v", "border_offset_u", "border_offset_v", "border_smooth_ubeg",
           "border_smooth_uend", "refline_continuation", "reference_line_continuation"},
          {"refline_search_", "warn_", "log_", "check_"}},
         {modifiers_section,
          {"scale_z_grid",        "scale_slope",       "scale_banking",    "scale_length",        "scale_width",
           "scale_curvature",     "grid_nan_mode",     "grid_nan_offset",  "refline_rotcenter_x", "refline_rotcenter_y",
           "refline_offset_phi",  "refline_offset_x",  "refline_offset_y", "refline_offset_z",    "refpoint_u",
           "refpoint_u_fraction", "refpoint_u_offset", "refpoint_v",       "refpoint_v_fraction", "refpoint_v_offset",
           "refpoint_x",          "refpoint_y",        "refpoint_z",       "refpoint_phi"},
          {}}}};
    for (const Known& of : known) {
        const auto section = sections_.find(of.section);
        if (section == sections_.end()) continue;
        for (const auto& [key, entry] : section->second.keys) {
            const std::string_view name = key;
            if (std::find(of.keys.begin(), of.keys.end(), name) == of.keys.end() &&
                std::none_of(of.beginnings.begin(), of.beginnings.end(),
                             [&](std::string_view begin) { return name.starts_with(begin); }))
                remarks_.push_back(remark(entry.line, key, "is no key of $" + of.section + " and not used"));
        }
    }
}

}  // namespace hamilcar::io::crg
