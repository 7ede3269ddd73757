#include "hamilcar/io/key_schema.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/io/spelling.hpp"

namespace hamilcar::io {

namespace {

Json number_schema(const ValueRule& rule) {
    Json out{{"type", "number"}};
    if (std::isfinite(rule.min)) out[rule.min_included ? "minimum" : "exclusiveMinimum"] = rule.min;
    if (std::isfinite(rule.max)) out["maximum"] = rule.max;
    if (rule.is_whole) out["multipleOf"] = 1;
    return out;
}

Json text_schema() {
    return {{"type", "string"}, {"minLength", 1}};
}

Json list_schema(const ValueRule& rule) {
    if (rule.shapes & Shape::texts) return {{"type", "array"}, {"items", text_schema()}};
    Json out{{"type", "array"}, {"items", number_schema(rule)}, {"minItems", std::max<std::size_t>(rule.count, 1)}};
    if (rule.count > 0) out["maxItems"] = rule.count;
    return out;
}

// The kinds of values that a rule allows, without what is below a table.
Json value_schema(const ValueRule& rule) {
    if (!rule.words.empty() && (rule.shapes & ~unsigned{Shape::text})) {  // a word in the place of something else
        ValueRule other = rule;
        other.shapes &= ~unsigned{Shape::text}, other.words.clear();
        return {{"anyOf", {value_schema(other), {{"enum", rule.words}}}}};
    }
    Json out = Json::object(), types = Json::array();
    const auto add = [&](const Json& more) {
        types.push_back(more["type"]);
        out.update(more);
    };
    if (rule.shapes & Shape::flag) add({{"type", "boolean"}});
    if (rule.shapes & Shape::number) add(number_schema(rule));
    if (rule.shapes & (Shape::numbers | Shape::texts)) add(list_schema(rule));
    if (rule.shapes & Shape::text) add(rule.words.empty() ? text_schema() : Json{{"type", "string"}});
    if (!rule.words.empty()) out["enum"] = rule.words;
    if (rule.shapes & Shape::table) add({{"type", "object"}});
    if (rule.shapes & Shape::tables) add({{"type", "array"}, {"minItems", 1}});
    if (types.size() > 1) out["type"] = types;
    return out;
}

std::string description(const KeyRecord& key) {
    std::vector<std::pair<std::string, std::string>> meanings;  // text, where it holds
    for (const Meaning& meaning : key.meanings) {
        const auto same = std::ranges::find(meanings, meaning.text, &std::pair<std::string, std::string>::first);
        if (same == meanings.end()) {
            meanings.emplace_back(meaning.text, meaning.where);
        } else if (!meaning.where.empty()) {
            same->second.append(", ").append(meaning.where);
        }
    }
    std::string out;
    for (const auto& [text, where] : meanings) {
        if (!where.empty()) out.append(where).append(": ");
        out.append(text).append("; ");
    }
    if (key.expectations.empty() && !key.value.words.empty()) {
        const std::vector<std::string_view> words(key.value.words.begin(), key.value.words.end());
        return out + quoted_list(words);
    }
    for (const std::string& expectation : key.expectations) {
        out += expectation + (&expectation == &key.expectations.back() ? "" : ", or ");
    }
    return out;
}

struct AsJson {
    Json operator()(std::monostate) const { return nullptr; }
    template <class Value>
    Json operator()(const Value& value) const {
        return value;
    }
};

// A schema of the tables at a key, as a schema of the key's value.
Json at_key(const KeyRecord& key, const Json& table) {
    return key.value.shapes & Shape::tables ? Json{{"items", table}} : table;
}

Json schema_of_all(const TableRecord& all);

Json key_schema(const KeyRecord& key) {
    Json out = value_schema(key.value);
    const std::string text = description(key);
    if (!text.empty()) out["description"] = text;
    const Json fallback = std::visit(AsJson{}, key.value.fallback);
    if (!fallback.is_null()) out["default"] = fallback;
    if (!key.below.empty()) out.update(at_key(key, schema_of_all(key.below[0])));
    return out;
}

Json all_required(const std::vector<std::string>& keys) {
    return {{"required", keys}};
}

// True of the table where one of these branches is taken.
Json condition(const Choice& choice, const std::vector<std::size_t>& branches) {
    using enum Choice::About;
    Json out = all_required({choice.key}), values = Json::array();
    if (choice.about == list) {
        out["properties"][choice.key] = {{"type", "array"}};
    } else if (choice.about == group) {
        out = Json::object();
        for (const std::string& key : choice.options[branches[0]]) out["anyOf"].push_back(all_required({key}));
        if (out["anyOf"].size() == 1) out = Json(out["anyOf"][0]);
    } else {
        for (const std::size_t i : branches)
            values.push_back(choice.about == flag ? Json(i == 1) : Json(choice.options[i][0]));
        if (choice.fallback && std::ranges::find(branches, *choice.fallback) != branches.end()) out = Json::object();
        out["properties"][choice.key] = values.size() == 1 ? Json{{"const", values[0]}} : Json{{"enum", values}};
    }
    if (choice.table.empty()) return out;
    Json outer = out.contains("required") ? all_required({choice.table}) : Json::object();
    outer["properties"][choice.table] = out;
    return outer;
}

void add_if_then_else(Json& to, const Json& condition, const Json& yes, const Json& no) {
    if (yes.empty() && no.empty()) return;
    Json out{{"if", condition}};
    if (!yes.empty()) out["then"] = yes;
    if (!no.empty()) out["else"] = no;
    to.push_back(out);
}

// What a choice asks for, the requirements of its branches given: nothing or several schemas.
Json schemas_of_choice(const Choice& choice, const std::vector<Json>& branches) {
    Json out = Json::array();
    if (choice.about == Choice::About::list || choice.about == Choice::About::group) {
        Json chain = branches[0];
        for (std::size_t i = 1; i < branches.size(); ++i) {
            Json next = Json::array();
            add_if_then_else(next, condition(choice, {i}), branches[i], chain);
            chain = next.empty() ? Json::object() : next[0];
        }
        if (!chain.empty()) out.push_back(chain);
        return out;
    }
    for (std::size_t first = 0; first < branches.size(); ++first) {
        std::vector<std::size_t> alike;
        for (std::size_t i = 0; i < branches.size(); ++i) {
            if (branches[i] == branches[first]) alike.push_back(i);
        }
        if (alike[0] == first) add_if_then_else(out, condition(choice, alike), branches[first], Json::object());
    }
    return out;
}

const TableRecord& below(const KeyRecord* key) {
    static const TableRecord nothing;
    return key && !key->below.empty() ? key->below[0] : nothing;
}

Json requirements(const TableRecord& table, const TableRecord& all, const TableRecord& beside);

// The choices of a table, in which `beside` may stand as well and all in all `allowed`.
Json schemas_of_choices(const TableRecord& table, const TableRecord& allowed, const TableRecord& beside) {
    Json out = Json::array();
    for (const Choice& choice : table.choices) {
        TableRecord rest = beside;
        TableRecord others = table;
        std::erase(others.choices, choice);
        join(rest, others);
        std::vector<Json> branches;
        for (const TableRecord& branch : choice.branches) branches.push_back(requirements(branch, allowed, rest));
        for (const Json& schema : schemas_of_choice(choice, branches)) out.push_back(schema);
    }
    return out;
}

// What a table wants that may hold `all`, in a branch only what is in `table` or in `beside`. Where a keyword is about all
// other keys, all that are allowed are listed beside it.
Json requirements(const TableRecord& table, const TableRecord& all, const TableRecord& beside) {
    TableRecord allowed = beside, around = beside;
    join(allowed, table);
    for (const Choice& choice : table.choices) {
        for (const TableRecord& branch : choice.branches) join(around, branch);
    }
    Json out = Json::object(), properties = Json::object(), required = Json::array(), others = Json::object();
    const bool has_fewer_keys = allowed.keys.size() < all.keys.size();
    for (const KeyRecord& key : allowed.keys) {
        const KeyRecord *own = table.find(key.key), *common = all.find(key.key);
        Json schema = value_schema(key.value);
        if (schema == value_schema(common->value)) schema = Json::object();
        if (!key.below.empty()) {
            const Json inner = requirements(below(own), below(common), below(around.find(key.key)));
            if (!inner.empty()) schema.update(at_key(key, inner));
        }
        const bool is_required = own && own->required();
        if (key.key == any_name) {
            others = schema;
            if (is_required) out["minProperties"] = 1;
        } else {
            if (is_required) required.push_back(key.key);
            if (has_fewer_keys || !schema.empty()) properties[key.key] = schema;
        }
    }
    if (!others.empty()) {
        for (const KeyRecord& key : allowed.keys) {
            if (key.key != any_name && !properties.contains(key.key)) properties[key.key] = Json::object();
        }
    }
    if (!required.empty()) out["required"] = required;
    if (!properties.empty()) out["properties"] = properties;
    if (has_fewer_keys && !allowed.find(any_name)) out["additionalProperties"] = false;
    if (!others.empty()) out["additionalProperties"] = others;
    const Json choices = schemas_of_choices(table, allowed, beside);
    if (choices.size() == 1) out.update(choices[0]);
    if (choices.size() > 1) out["allOf"] = choices;
    return out;
}

// The schema of a record without choices.
Json schema_of_all(const TableRecord& all) {
    Json out{{"type", "object"}, {"properties", Json::object()}, {"additionalProperties", false}};
    for (const KeyRecord& key : all.keys) {
        (key.key == any_name ? out["additionalProperties"] : out["properties"][key.key]) = key_schema(key);
    }
    return out;
}

}  // namespace

Json table_schema(const TableRecord& table) {
    TableRecord all;
    join(all, table);
    return schema_of_all(all);
}

Json requirements(const TableRecord& table) {
    TableRecord all;
    join(all, table);
    return requirements(table, all, {});
}

}  // namespace hamilcar::io
