#include "hamilcar/io/tir_entries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hamilcar/base/text.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/tir_keys.hpp"
#include "hamilcar/io/tir_limits.hpp"

namespace hamilcar::io {

void TirEntries::note(std::size_t line, const std::string& text) {
    notes_.push_back(line ? fmt::format("{}:{}: {}", file_.path, line, text) : fmt::format("{}: {}", file_.path, text));
}

void TirEntries::fail(std::size_t line, const std::string& text) const {
    if (line) fail_in_property_file(file_.path, line, text);
    throw Error(ExitCode::bad_file, file_.path + ": " + text);
}

bool TirEntries::is_used(const PropertyEntry* entry) const {
    return std::ranges::find(used_, entry) != used_.end();
}

const PropertyEntry* TirEntries::find_in_file(std::string_view key) const {
    for (const PropertySection& section : file_.sections) {
        if (section.name == "UNITS" || section.name.starts_with("MDI_HEADER")) continue;
        for (const PropertyEntry& entry : section.entries) {
            if (entry.key == key) return &entry;
        }
    }
    return nullptr;
}

const PropertyEntry* TirEntries::find(std::string_view key) {
    const PropertyEntry* entry = find_in_file(key);
    if (entry && !is_used(entry)) used_.push_back(entry);
    return entry;
}

std::size_t TirEntries::line_of(std::string_view key) {
    const PropertyEntry* entry = find(key);
    return entry ? entry->line : 0;
}

std::optional<double> TirEntries::optional(std::string_view key, double unit) {
    const PropertyEntry* entry = find(key);
    if (!entry || (entry->text.empty() && !entry->quoted)) return std::nullopt;
    if (!entry->number) {
        fail(entry->line, fmt::format("key '{}' = {}: expected a number", key, quoted_text(entry->text)));
    }
    if (!(std::abs(unit * *entry->number) <= max_in_tir)) {
        fail(entry->line, fmt::format("key '{}' = {}: expected a number of {:g} at most, in SI", key,
                                      quoted_text(entry->text), max_in_tir));
    }
    return unit * *entry->number;
}

std::optional<double> TirEntries::either(std::string_view key, std::string_view older, double unit) {
    const auto value = optional(key, unit);
    return value ? value : optional(older, unit);
}

double TirEntries::positive(std::string_view key, double unit) {
    const std::optional<double> value = optional(key, unit);
    if (!value) fail(0, fmt::format("missing required key '{}'", key));
    if (!(*value >= min_in_tir)) {
        fail(line_of(key), fmt::format("key '{}' = {:g}: expected a positive number, {:g} at least in SI", key,
                                       *value / unit, min_in_tir));
    }
    return *value;
}

double TirEntries::number(std::string_view key, double fallback, double unit) {
    const std::optional<double> value = optional(key, unit);
    if (!value) note(line_of(key), fmt::format("no '{}': taken as {:g}", key, fallback / unit));
    return value.value_or(fallback);
}

void TirEntries::list_the_rest() {
    constexpr std::size_t max_compared = 1000;  // with every key there is, which takes its time
    for (const PropertySection& section : file_.sections) {
        if (section.name == "UNITS" || section.name.starts_with("MDI_HEADER")) continue;
        for (const PropertyEntry& entry : section.entries) {
            if (entry.key.empty() || is_used(&entry)) continue;
            if (const PropertyEntry* first = find_in_file(entry.key); first != &entry && is_used(first)) {
                note(entry.line,
                     fmt::format("duplicate key '{}': the value in line {} is used", entry.key, first->line));
                continue;
            }
            const bool known = is_known_but_unused(entry.key);
            if (known && entry.number && *entry.number == 0) continue;  // asks for nothing
            const auto nearest = known || notes_.size() > max_compared ? std::nullopt : nearest_key(entry.key);
            note(entry.line, fmt::format("key '{}' in [{}] is {}{}", entry.key, section.name,
                                         known ? "not used" : "not known and not used",
                                         nearest ? fmt::format("; did you mean '{}'?", *nearest) : ""));
        }
        if (!section.rows.empty() && std::ranges::find(used_tables_, &section) == used_tables_.end())
            note(section.table_line, fmt::format("the table of [{}] is not used", section.name));
    }
}

}  // namespace hamilcar::io
