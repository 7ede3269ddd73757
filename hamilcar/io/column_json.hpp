// A channel as pages read it, in documents and over the live link alike (schemas/page.schema.json, "channel").
#pragma once

#include <nlohmann/json.hpp>

#include "hamilcar/io/results.hpp"

namespace hamilcar::io {

inline nlohmann::json column_json(const Column& column) {
    nlohmann::json json{{"name", column.name}, {"unit", column.unit}, {"description", column.description}};
    if (column.role == ChannelRole::none) return json;
    json["role"] = text(column.role);
    json["of"] = column.of;
    if (const DisplayUnit display = display_unit(column.role); !display.unit.empty()) {
        json["display"] = {{"unit", display.unit}, {"factor", display.factor}};
    }
    return json;
}

}  // namespace hamilcar::io
