#include "hamilcar/live/access.hpp"

#include <fmt/format.h>
#include <sys/random.h>

#include <array>

#include "hamilcar/io/error.hpp"

namespace hamilcar::live {

namespace {

enum Status { switching = 101, ok = 200, forbidden = 403, not_found = 404, not_allowed = 405, upgrade_required = 426 };

// The value of `token` in a query; empty if it is absent.
std::string_view token_in(std::string_view query) {
    constexpr std::string_view name = "token=";
    while (!query.empty()) {
        const std::string_view part = query.substr(0, query.find('&'));
        if (part.starts_with(name)) return part.substr(name.size());
        query.remove_prefix(std::min(part.size() + 1, query.size()));
    }
    return {};
}

}  // namespace

Access::Access(std::string token, std::uint16_t port)
    : token_(std::move(token)), address_(fmt::format("127.0.0.1:{}", port)), name_(fmt::format("localhost:{}", port)) {}

bool Access::is_host(std::string_view host) const {
    return host == address_ || host == name_;
}

int Access::judge(const HttpRequest& request) const {
    if (!is_host(request.host)) return forbidden;
    if (request.method != "GET" && request.method != "HEAD") return not_allowed;
    const std::size_t mark = request.target.find('?');
    const std::string_view path = request.target.substr(0, mark);
    if (path != "/" && path != "/live") return not_found;
    const std::string_view query = mark == std::string_view::npos ? "" : request.target.substr(mark + 1);
    if (!same_secret(token_in(query), token_)) return forbidden;
    if (path == "/") return ok;
    constexpr std::string_view scheme = "http://";
    if (!request.origin.starts_with(scheme) || !is_host(request.origin.substr(scheme.size()))) return forbidden;
    return request.upgrade ? switching : upgrade_required;
}

std::string Access::url() const {
    return fmt::format("http://{}/?token={}", address_, token_);
}

// The page is a single file: inline script and style, generated images, and the live link.
std::string Access::content_security_policy() const {
    return fmt::format(
        "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; "
        "connect-src 'self' ws://{} ws://{}; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
        address_, name_);
}

std::string refusal_text(int status, std::string_view reason) {
    if (status != forbidden) return fmt::format("{}\n", reason);
    return fmt::format("{}. If the program was restarted, open the address that it printed.\n", reason);
}

std::string random_token() {
    std::array<unsigned char, 16> bytes{};
    if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
        throw io::Error(io::ExitCode::input_output, "cannot get random numbers from the system");
    }
    return fmt::format("{:02x}", fmt::join(bytes, ""));
}

bool same_secret(std::string_view given, std::string_view secret) {
    unsigned different = given.size() != secret.size();
    for (std::size_t i = 0; i < given.size(); ++i) {
        const char expected = secret.empty() ? '\0' : secret[i % secret.size()];
        different |= static_cast<unsigned char>(given[i] ^ expected);
    }
    return different == 0;
}

}  // namespace hamilcar::live
