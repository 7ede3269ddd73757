#include "hamilcar/io/bodywork_file.hpp"

#include "hamilcar/base/text.hpp"

namespace hamilcar::io {

std::optional<BodyworkDescription> read_bodywork(const std::optional<TableReader>& table) {
    if (!table) return {};
    BodyworkDescription body{
        .style = static_cast<BodyStyle>(table->one_of("style", body_style_names)),
        .front = table->number("front_m", any_number),
        .length = table->number("length_m", positive),
        .width = table->number("width_m", positive),
        .bottom = table->number("bottom_m", any_number),
        .top = table->number("top_m", any_number),
    };
    table->expect(body.top > body.bottom, "top_m", "a height above bottom_m = " + number_text(body.bottom));
    return body;
}

}  // namespace hamilcar::io
