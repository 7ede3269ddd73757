#include "hamilcar/io/key_schema.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "hamilcar/io/spelling.hpp"

namespace hamilcar::io {

namespace {

Json number_schema(const ValueRule& rule) {
    Json out{{"type", "number"}};
    if (std::isfinite(rule.least)) out[rule.least_included ? "minimum" : "exclusiveMinimum"] = rule.least;
    if (std::isfinite(rule.most)) out["maximum"] = rule.most;
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
    if (!key.value.words.empty()) {
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

Json key_schema(const KeyRecord& key) {
    Json out = value_schema(key.value);
    const std::string text = description(key);
    if (!text.empty()) out["description"] = text;
    const Json otherwise = std::visit(AsJson{}, key.value.otherwise);
    if (!otherwise.is_null()) out["default"] = otherwise;
    if (!key.below.empty()) out.update(at_key(key, table_schema(key.below[0])));
    return out;
}

TableRecord with_nothing_required(TableRecord table) {
    table.choices.clear();
    for (KeyRecord& key : table.keys) {
        key.required = false;
        for (TableRecord& below : key.below) below = with_nothing_required(below);
    }
    return table;
}

Json without_empty(const Json& properties) {
    Json out = Json::object();
    for (const auto& [key, schema] : properties.items()) {
        if (!schema.empty()) out[key] = schema;
    }
    return out;
}

Json narrowed(const TableRecord& common, const TableRecord& variant);

Json narrowed_value(const KeyRecord& common, const KeyRecord& variant) {
    Json out = value_schema(variant.value);
    if (out == value_schema(common.value)) out = Json::object();
    if (variant.below.empty()) return out;
    const Json below = narrowed(common.below[0], variant.below[0]);
    if (!below.empty()) out.update(at_key(variant, below));
    return out;
}

// What holds for a variant beyond what it has in common with others. Where a keyword is about all other keys, all keys
// that the variant has are listed beside it.
Json narrowed(const TableRecord& common, const TableRecord& variant) {
    Json out = Json::object(), properties = Json::object(), required = Json::array(), others = Json::object();
    for (const KeyRecord& key : variant.keys) {
        const KeyRecord& known = *common.find(key.key);
        const bool newly_required = key.required && !known.required;
        if (key.key == any_name) {
            others = narrowed_value(known, key);
            if (newly_required) out["minProperties"] = 1;
        } else {
            properties[key.key] = narrowed_value(known, key);
            if (newly_required) required.push_back(key.key);
        }
    }
    const bool has_fewer_keys = variant.keys.size() < common.keys.size();
    if (!has_fewer_keys && others.empty()) properties = without_empty(properties);
    if (!required.empty()) out["required"] = required;
    if (!properties.empty()) out["properties"] = properties;
    if (has_fewer_keys && !variant.find(any_name)) out["additionalProperties"] = false;
    if (!others.empty()) out["additionalProperties"] = others;
    Json choices = Json::array();
    for (const Json& choice : variant.choices) {
        if (std::ranges::find(common.choices, choice) == common.choices.end()) choices.push_back(choice);
    }
    if (choices.size() == 1) out.update(choices[0]);
    if (choices.size() > 1) out["allOf"] = choices;
    return out;
}

Json all_required(const std::vector<std::string>& keys) {
    return {{"required", keys}};
}

// True of the decision's table where one of these options is taken.
Json condition(const Decision& decision, const std::vector<std::size_t>& options) {
    const std::vector<std::string> key{decision.key};
    Json out = all_required(key), values = Json::array();
    switch (decision.about) {
        case Decision::About::presence: return out;
        case Decision::About::list: out["properties"][decision.key] = {{"type", "array"}}; return out;
        case Decision::About::group:
            out = Json::object();
            for (const std::string& one : decision.options[options[0]]) {
                out["anyOf"].push_back(all_required({one}));
            }
            return out["anyOf"].size() == 1 ? Json(out["anyOf"][0]) : out;
        case Decision::About::flag:
            for (const std::size_t option : options) values.push_back(option == 1);
            break;
        case Decision::About::word:
            for (const std::size_t option : options) values.push_back(decision.options[option][0]);
    }
    const bool may_miss = decision.otherwise && std::ranges::find(options, *decision.otherwise) != options.end();
    if (may_miss) out = Json::object();
    out["properties"][decision.key] = values.size() == 1 ? Json{{"const", values[0]}} : Json{{"enum", values}};
    return out;
}

Json if_then_else(const Json& condition, const Json& yes, const Json& no) {
    if (yes.empty() && no.empty()) return Json::object();
    Json out{{"if", condition}};
    if (!yes.empty()) out["then"] = yes;
    if (!no.empty()) out["else"] = no;
    return out;
}

// A condition on a table below as one on the table above; it may hold without the table where it may hold without a
// key.
Json seen_from_above(Json condition, const TablePath& below) {
    for (std::size_t i = below.size(); i-- > 0;) {
        const bool must_exist = condition.contains("required") || condition.contains("anyOf");
        Json outer = must_exist ? all_required({below[i]}) : Json::object();
        outer["properties"][below[i]] = condition;
        condition = outer;
    }
    return condition;
}

// A condition says something about one table, not about all tables of a list.
void expect_single_tables(const TableRecord& from, const TablePath& below) {
    const TableRecord* at = &from;
    for (const std::string& step : below) {
        const KeyRecord* key = at->find(step);
        if (step == any_name || key->value.shapes & Shape::tables) {
            throw std::logic_error("what stands in one of the tables '" + step + "' decides about keys outside of it");
        }
        at = &key->below[0];
    }
}

}  // namespace

Json table_schema(const TableRecord& table) {
    Json out{{"type", "object"}, {"properties", Json::object()}, {"additionalProperties", false}};
    for (const KeyRecord& key : table.keys) {
        (key.key == any_name ? out["additionalProperties"] : out["properties"][key.key]) = key_schema(key);
    }
    return out;
}

Json requirements(const TableRecord& table) {
    return narrowed(with_nothing_required(table), table);
}

TableRecord joined_by_choice(const std::vector<TableRecord>& variants, const Decision& decision, std::size_t depth) {
    TableRecord common = variants[0];
    for (const TableRecord& variant : variants) join(common, variant);
    const TablePath below(decision.table.begin() + static_cast<std::ptrdiff_t>(depth), decision.table.end());
    expect_single_tables(common, below);
    std::vector<Json> narrow;
    for (const TableRecord& variant : variants) narrow.push_back(narrowed(common, variant));
    const auto when = [&](const std::vector<std::size_t>& options) {
        return seen_from_above(condition(decision, options), below);
    };
    std::vector<Json> choices;
    if (decision.about == Decision::About::presence) {
        choices.push_back(if_then_else(when({0}), narrow[0], narrow[1]));
    } else if (decision.about == Decision::About::list || decision.about == Decision::About::group) {
        Json chain = narrow[0];
        for (std::size_t option = 1; option < narrow.size(); ++option) {
            chain = if_then_else(when({option}), narrow[option], chain);
        }
        choices.push_back(chain);
    } else {
        for (std::size_t first = 0; first < narrow.size(); ++first) {
            std::vector<std::size_t> alike;
            for (std::size_t i = 0; i < narrow.size(); ++i) {
                if (narrow[i] == narrow[first]) alike.push_back(i);
            }
            if (alike[0] == first) choices.push_back(if_then_else(when(alike), narrow[first], Json::object()));
        }
    }
    std::ranges::copy_if(choices, std::back_inserter(common.choices),
                         [](const Json& choice) { return !choice.empty(); });
    return common;
}

}  // namespace hamilcar::io
