// The page as the web build left it, taken into the program byte by byte.
#include "hamilcar/io/page.hpp"

asm(R"(
    .section .rodata
    .global hamilcar_page_begin
    .global hamilcar_page_end
hamilcar_page_begin:
    .incbin ")" HAMILCAR_PAGE R"("
hamilcar_page_end:
    .byte 0
    .text
)");

extern "C" const char hamilcar_page_begin[], hamilcar_page_end[];

namespace hamilcar::io {

std::string_view page_template() {
    return {hamilcar_page_begin, static_cast<std::size_t>(hamilcar_page_end - hamilcar_page_begin)};
}

}  // namespace hamilcar::io
