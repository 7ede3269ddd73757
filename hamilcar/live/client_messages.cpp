#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "hamilcar/live/messages.hpp"

namespace hamilcar::live {

namespace {

using nlohmann::json;
using Scalar = std::variant<std::nullptr_t, bool, std::uint64_t, double, std::string>;
using Fields = std::map<std::string, Scalar, std::less<>>;

// Receives the parser's events and stops it at anything but one flat object of scalars: no nesting, no tree in memory.
class FlatObject final : public nlohmann::json_sax<json> {
public:
    Fields fields;
    std::string problem;

    bool start_object(std::size_t) override { return expect(!std::exchange(open_, true)); }
    bool start_array(std::size_t) override { return expect(false); }
    bool end_object() override { return true; }
    bool end_array() override { return true; }
    bool key(std::string& name) override {
        key_ = name;
        return !fields.contains(name) || fail(fmt::format("duplicate key '{}'", name));
    }
    bool null() override { return add(nullptr); }
    bool boolean(bool value) override { return add(value); }
    bool number_integer(std::int64_t value) override { return add(static_cast<double>(value)); }  // negative
    bool number_unsigned(std::uint64_t value) override { return add(value); }
    bool number_float(double value, const std::string&) override { return add(value); }
    bool string(std::string& value) override { return add(value); }
    bool binary(json::binary_t&) override { return expect(false); }
    bool parse_error(std::size_t at, const std::string&, const json::exception&) override {
        return fail(fmt::format("not JSON near byte {}", at));
    }

private:
    bool add(Scalar value) {
        if (!open_) return expect(false);
        fields.emplace(key_, std::move(value));
        return true;
    }
    bool expect(bool flat) { return flat || fail("expected one flat object"); }
    bool fail(std::string message) {
        problem = std::move(message);
        return false;
    }

    bool open_ = false;
    std::string key_;
};

// Extracts fields one by one and keeps the first error.
class FieldReader {
public:
    explicit FieldReader(Fields fields) : fields_(std::move(fields)) {}

    bool has(const char* name) const { return fields_.contains(name); }
    bool flag(const char* name) { return take<bool>(name, "true or false").value_or(false); }
    std::string text(const char* name) { return take<std::string>(name, "a string").value_or(""); }
    double number(const char* name, double low, double high) {
        const std::string range = fmt::format("a number from {:g} to {:g}", low, high);
        const auto found = fields_.find(name);
        if (found != fields_.end()) {
            if (const auto* whole = std::get_if<std::uint64_t>(&found->second)) {
                found->second = static_cast<double>(*whole);
            }
        }
        const double value = take<double>(name, range).value_or(low);
        if (!(value >= low && value <= high)) report(name, range);
        return value;
    }
    std::uint32_t count(const char* name) {
        const std::uint64_t value = take<std::uint64_t>(name, "a whole number").value_or(0);
        if (value > std::numeric_limits<std::uint32_t>::max()) report(name, "at most 32 bits");
        return static_cast<std::uint32_t>(value);
    }
    void report(const std::string& name, std::string_view expected) {
        if (problem_.empty()) problem_ = fmt::format("'{}': expected {}", name, expected);
    }
    // The first error, or an unknown key that is left over, or "".
    std::string problem() const {
        if (problem_.empty() && !fields_.empty()) return fmt::format("unknown key '{}'", fields_.begin()->first);
        return problem_;
    }

private:
    template <class T>
    std::optional<T> take(const char* name, std::string_view expected) {
        const auto node = fields_.extract(name);
        if (node && std::holds_alternative<T>(node.mapped())) return std::get<T>(node.mapped());
        report(name, expected);
        return std::nullopt;
    }

    Fields fields_;
    std::string problem_;
};

Device read_device(FieldReader& fields) {
    const std::string device = fields.text("device");
    if (device != "keys" && device != "axes") fields.report("device", "\"keys\" or \"axes\"");
    return device == "axes" ? Device::axes : Device::keys;
}

Selector read_selector(FieldReader& fields) {
    constexpr std::pair<const char*, Selector> known[] = {{"drive", Selector::drive},
                                                          {"neutral", Selector::neutral},
                                                          {"reverse", Selector::reverse},
                                                          {"manual", Selector::manual}};
    const std::string word = fields.text("selector");
    for (const auto& [name, selector] : known) {
        if (word == name) return selector;
    }
    fields.report("selector", "\"drive\", \"neutral\", \"reverse\" or \"manual\"");
    return Selector::drive;
}

// Selector, gear and clutch come together or not at all.
ClientMessage read_input(FieldReader& f) {
    InputMessage input;
    input.sequence = f.count("sequence");
    const bool back = f.flag("reverse");
    input.controls = {.device = read_device(f),
                      .steer = f.number("steer", -1, 1),
                      .throttle = f.number("throttle", 0, 1),
                      .brake = f.number("brake", 0, 1),
                      .selector = back ? Selector::reverse : Selector::drive};
    if (!f.has("selector") && !f.has("gear") && !f.has("clutch")) return input;
    input.controls.selector = read_selector(f);
    if (back != (input.controls.selector == Selector::reverse)) f.report("reverse", "the direction of the selector");
    const std::uint32_t gear = f.count("gear");
    if (gear < 1 || gear > max_gears) f.report("gear", fmt::format("a gear from 1 to {}", max_gears));
    input.controls.gear = static_cast<int>(gear);
    input.controls.clutch = f.number("clutch", 0, 1);
    return input;
}

ClientMessage read_load(FieldReader& f) {
    return LoadMessage{{f.text("vehicle"), f.text("road"), f.number("friction", 0.05, 1.5)}};
}

const std::map<std::string, ClientMessage (*)(FieldReader&), std::less<>>& readers() {
    static const std::map<std::string, ClientMessage (*)(FieldReader&), std::less<>> list{
        {"input", read_input},
        {"load", read_load},
        {"reset", [](FieldReader&) -> ClientMessage { return ResetMessage{}; }},
        {"pause", [](FieldReader& f) -> ClientMessage { return PauseMessage{f.flag("on")}; }},
        {"pace", [](FieldReader& f) -> ClientMessage { return PaceMessage{f.number("factor", 0.05, 1)}; }},
        {"record", [](FieldReader& f) -> ClientMessage { return RecordMessage{f.flag("on")}; }},
        {"switch",
         [](FieldReader& f) -> ClientMessage {
             return SwitchMessage{f.text("aid"), f.flag("on")};
         }},
        {"take", [](FieldReader&) -> ClientMessage { return TakeMessage{}; }},
    };
    return list;
}

}  // namespace

std::variant<ClientMessage, InvalidMessage> read_message(std::string_view text) {
    FlatObject object;
    if (!json::sax_parse(text, &object)) return InvalidMessage{object.problem};
    FieldReader fields(std::move(object.fields));
    const auto reader = readers().find(fields.text("type"));
    if (reader == readers().end()) fields.report("type", "input, load, reset, pause, pace, record, switch or take");
    if (reader == readers().end()) return InvalidMessage{fields.problem()};
    ClientMessage message = reader->second(fields);
    if (const std::string problem = fields.problem(); !problem.empty()) {
        return InvalidMessage{fmt::format("{}: {}", reader->first, problem)};
    }
    return message;
}

}  // namespace hamilcar::live
