#include "hamilcar/live/access.hpp"

#include <fmt/format.h>
#include <sys/random.h>

#include <array>

#include "hamilcar/io/error.hpp"

namespace hamilcar::live {

namespace {

enum Status { switching = 101, ok = 200, forbidden = 403, not_found = 404, not_allowed = 405, upgrade_required = 426 };

// The value of NAME in a list "NAME=VALUE", as queries and cookies are; empty if it is absent.
std::string_view value_in(std::string_view list, std::string_view name, char separator) {
    while (!list.empty()) {
        std::string_view part = list.substr(0, list.find(separator));
        list.remove_prefix(std::min(part.size() + 1, list.size()));
        part.remove_prefix(std::min(part.find_first_not_of(' '), part.size()));
        if (part.starts_with(name) && part.substr(name.size()).starts_with('=')) return part.substr(name.size() + 1);
    }
    return {};
}

constexpr std::string_view cookie_name = "hamilcar";

std::string_view path_of(std::string_view target) {
    return target.substr(0, target.find('?'));
}

std::string_view token_in(std::string_view target) {
    const std::size_t path = path_of(target).size();
    return path == target.size() ? "" : value_in(target.substr(path + 1), "token", '&');
}

}  // namespace

Secrets random_secrets() {
    return {random_token(), random_token(), random_token(), random_token()};
}

Access::Access(Secrets secrets, std::uint16_t port)
    : secrets_(std::move(secrets)),
      address_(fmt::format("127.0.0.1:{}", port)),
      name_(fmt::format("localhost:{}", port)) {}

bool Access::is_host(std::string_view host) const {
    return host == address_ || host == name_;
}

bool Access::opens(std::string_view token) const {
    return same_secret(token, secrets_.token) || same_secret(token, secrets_.once);
}

bool Access::is_entrance(std::string_view target) {
    return path_of(target) == "/";
}

int Access::judge(const HttpRequest& request) const {
    if (!is_host(request.host)) return forbidden;
    if (request.method != "GET" && request.method != "HEAD") return not_allowed;
    if (is_entrance(request.target)) return opens(token_in(request.target)) ? ok : forbidden;
    const std::string_view path = path_of(request.target);
    const bool is_page = path == page_path();
    if (!is_page && path != page_path() + "live") return not_found;
    if (!same_secret(value_in(request.cookie, cookie_name, ';'), secrets_.session)) return forbidden;
    if (is_page) return ok;
    constexpr std::string_view scheme = "http://";
    if (!request.origin.starts_with(scheme) || !is_host(request.origin.substr(scheme.size()))) return forbidden;
    return request.upgrade ? switching : upgrade_required;
}

void Access::entered(std::string_view target) {
    if (same_secret(token_in(target), secrets_.once)) secrets_.once.clear();
}

std::string Access::url() const {
    return fmt::format("http://{}/?token={}", address_, secrets_.token);
}

std::string Access::url_once() const {
    return fmt::format("http://{}/?token={}", address_, secrets_.once);
}

std::string Access::cookie() const {
    return fmt::format("{}={}; Path={}; HttpOnly; SameSite=Strict", cookie_name, secrets_.session, page_path());
}

// A page that goes on by itself, not a redirection: a browser that comes from elsewhere, from a file or a chat, would follow a
// redirection without the cookie, which is strict.
std::string Access::entrance_page() const {
    return fmt::format(
        "<!doctype html><meta charset=\"utf-8\"><title>Hamilcar</title><link rel=\"icon\" href=\"data:,\">\n"
        "<meta http-equiv=\"refresh\" content=\"0; url={0}\"><a href=\"{0}\">Drive</a>\n",
        page_path());
}

// The page is a single file: inline script and style, generated images, and the live link.
std::string Access::content_security_policy(std::string_view inline_policy) const {
    return fmt::format(
        "default-src 'none'; {}{}img-src data: blob:; connect-src 'self' ws://{} ws://{}; base-uri 'none'; "
        "form-action 'none'; frame-ancestors 'none'",
        inline_policy, inline_policy.empty() ? "" : "; ", address_, name_);
}

std::string inline_policy_of(std::string_view page) {
    constexpr std::string_view start = "<meta http-equiv=\"Content-Security-Policy\" content=\"";
    const std::string_view head = page.substr(0, page.find("<script"));
    const std::size_t at = head.find(start);
    if (at == head.npos) return {};
    const std::string_view rest = head.substr(at + start.size());
    return std::string(rest.substr(0, rest.find('"')));
}

std::string refusal_text(int status, std::string_view reason) {
    if (status != forbidden) return fmt::format("{}\n", reason);
    return fmt::format("{}. If the program was restarted, open the address that it printed. Cookies must be allowed.\n",
                       reason);
}

std::string random_token() {
    std::array<unsigned char, 16> bytes{};
    if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
        throw io::Error(io::ExitCode::input_output, "cannot get random numbers from the system");
    }
    return fmt::format("{:02x}", fmt::join(bytes, ""));
}

bool same_secret(std::string_view given, std::string_view secret) {
    unsigned different = given.size() != secret.size() || secret.empty();
    for (std::size_t i = 0; i < given.size(); ++i) {
        const char expected = secret.empty() ? '\0' : secret[i % secret.size()];
        different |= static_cast<unsigned char>(given[i] ^ expected);
    }
    return different == 0;
}

}  // namespace hamilcar::live
