#include "hamilcar/io/key_recorder.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "hamilcar/io/key_unit.hpp"
#include "hamilcar/io/spelling.hpp"

namespace hamilcar::io {

namespace {

ValueRule of_shape(unsigned shape) {
    ValueRule rule;
    rule.shapes = shape;
    return rule;
}

ValueRule in_range(unsigned shape, const Range& range) {
    ValueRule rule = of_shape(shape);
    rule.least = range.least, rule.most = range.most, rule.least_included = range.least_included;
    rule.is_whole = range.is_whole;
    return rule;
}

std::string joined(const std::string& place, std::string_view key) {
    return place.empty() ? std::string(key) : place + "." + std::string(key);
}

}  // namespace

std::string Decision::id() const {
    std::string id;
    for (const std::string& step : table) id += step + ".";
    return id + key + " " + std::to_string(static_cast<int>(about));
}

KeyRecord& KeyRecorder::ask(const std::string& place, std::string_view key, bool required, const ValueRule& value,
                            const std::string& expectation) {
    TableRecord& table = instances_.at(place).record;
    KeyRecord now{std::string(key), value, {}, {}, required, {}};
    if (!expectation.empty()) now.expectations.push_back(expectation);
    KeyRecord* known = table.find(key);
    if (!known) return table.keys.emplace_back(now);
    const bool wanted = known->required || required;
    join(*known, now);
    known->required = wanted;
    return *known;
}

std::size_t KeyRecorder::decide(const std::string& place, Decision decision, std::size_t usual) {
    decision.table = instances_.at(place).path;
    const std::string id = decision.id();
    const auto answer = answers_.find(id);
    decision.taken = answer == answers_.end() ? usual : answer->second;
    if (decision.taken >= decision.options.size()) throw std::logic_error("key '" + id + "' is read in two ways");
    if (met_.insert(id).second) decisions_.push_back(decision);
    return decision.taken;
}

bool KeyRecorder::has(const std::string& place, std::string_view key) {
    ask(place, key, false, {}, "");
    instances_.at(place).may_miss.emplace(key);
    return decide(place, {Decision::About::presence, {}, std::string(key), {{}, {}}, {}}, 0) == 0;
}

bool KeyRecorder::has_list(const std::string& place, std::string_view key) {
    ask(place, key, false, {}, "");
    return decide(place, {Decision::About::list, {}, std::string(key), {{}, {}}, {}}, 0) == 1;
}

// The keys themselves are asked for by whoever reads the group.
std::size_t KeyRecorder::chosen(const std::string& place, Alternatives groups) {
    Decision decision{Decision::About::group, {}, std::string(*groups.begin()->begin()), {}, {}};
    for (const auto& group : groups) decision.options.emplace_back(group.begin(), group.end());
    return decide(place, decision, 0);
}

void KeyRecorder::number(const std::string& place, std::string_view key, const Range& range,
                         std::optional<double> otherwise) {
    ValueRule rule = in_range(Shape::number, range);
    const double written = otherwise.value_or(0) / unit_of_key(key).to_si;
    const bool enough = range.least_included ? written >= range.least : written > range.least;
    if (otherwise && enough && written <= range.most) rule.otherwise = written;  // or "none", or another key's value
    ask(place, key, !otherwise, rule, with_unit("a " + std::string(range.words), key));
}

void KeyRecorder::numbers(const std::string& place, std::string_view key, const Range& range, std::size_t count,
                          std::span<const double> otherwise) {
    ValueRule rule = in_range(Shape::numbers, range);
    rule.count = count;
    std::vector<double> written;
    for (const double value : otherwise) written.push_back(value / unit_of_key(key).to_si);
    const bool from_elsewhere = std::ranges::any_of(written, [](double value) { return std::isnan(value); });
    if (!written.empty() && !from_elsewhere) rule.otherwise = written;
    ask(place, key, otherwise.empty(), rule,
        with_unit(count > 0 ? std::to_string(count) + " numbers" : "a list of numbers", key));
}

bool KeyRecorder::flag(const std::string& place, std::string_view key, bool otherwise) {
    ValueRule rule = of_shape(Shape::flag);
    rule.otherwise = otherwise;
    ask(place, key, false, rule, "true or false");
    const std::size_t usual = otherwise ? 1 : 0;
    return decide(place, {Decision::About::flag, {}, std::string(key), {{}, {}}, usual}, usual) == 1;
}

void KeyRecorder::text(const std::string& place, std::string_view key) {
    ask(place, key, true, of_shape(Shape::text), "a text in quotes");
}

void KeyRecorder::texts(const std::string& place, std::string_view key) {
    ask(place, key, false, of_shape(Shape::texts), "a list of texts in quotes");
}

// Names that a person invents make a list of words open: it is no fork then, and any text will do.
std::size_t KeyRecorder::one_of(const std::string& place, std::string_view key, std::span<const std::string_view> words,
                                std::optional<std::size_t> otherwise) {
    ValueRule rule = of_shape(Shape::text);
    std::vector<std::string_view> fixed;
    std::ranges::copy_if(words, std::back_inserter(fixed), [](std::string_view word) { return word != any_name; });
    const bool open = words.empty() || fixed.size() < words.size();
    std::string expectation;  // closed lists tell their words themselves
    if (open) expectation = (fixed.empty() ? "" : quoted_list(fixed) + " or ") + "a name from this file";
    if (!open) rule.words.assign(words.begin(), words.end());
    if (otherwise && words[*otherwise] != any_name) rule.otherwise = std::string(words[*otherwise]);
    ask(place, key, !otherwise, rule, expectation);
    const std::size_t usual = otherwise.value_or(0);
    if (open || words.size() < 2) return usual;
    Decision decision{Decision::About::word, {}, std::string(key), {}, otherwise};
    for (const std::string_view word : words) decision.options.push_back({std::string(word)});
    return decide(place, decision, usual);
}

void KeyRecorder::add_below(const std::string& place, std::string_view key, const std::string& below) {
    auto& list = instances_.at(place).below[std::string(key)];
    if (std::ranges::find(list, below) != list.end()) return;
    list.push_back(below);
    TablePath path = instances_.at(place).path;
    path.emplace_back(key);
    instances_[below].path = path;
}

std::string KeyRecorder::table(const std::string& place, std::string_view key) {
    ask(place, key, true, of_shape(Shape::table), "");
    add_below(place, key, joined(place, key));
    return joined(place, key);
}

std::vector<std::string> KeyRecorder::tables(const std::string& place, std::string_view key) {
    ask(place, key, true, of_shape(Shape::tables), "");
    std::vector<std::string> places;
    for (const char* index : {"[0]", "[1]"}) {
        places.push_back(joined(place, key) + index);
        add_below(place, key, places.back());
    }
    return places;
}

void KeyRecorder::note(const std::string& place, std::string_view key, std::string_view meaning,
                       std::string_view where) {
    KeyRecord* known = instances_.at(place).record.find(key);
    if (known) known->meanings = {{std::string(meaning), std::string(where)}};
}

TableRecord KeyRecorder::record_at(const std::string& place) const {
    const Instance& instance = instances_.at(place);
    TableRecord out = instance.record;
    for (KeyRecord& key : out.keys) {
        key.required = key.required && !instance.may_miss.contains(key.key);
        const auto below = instance.below.find(key.key);
        if (below == instance.below.end()) continue;
        for (const std::string& table : below->second) {
            if (key.below.empty()) {
                key.below.push_back(record_at(table));
            } else {
                join(key.below[0], record_at(table));
            }
        }
    }
    return out;
}

}  // namespace hamilcar::io
