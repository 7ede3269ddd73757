// A new connection: reads an HTTP request and answers with the page, the live link or a refusal. Only for server.cpp.
#pragma once

#include <list>
#include <optional>

#include "hamilcar/live/http_request.hpp"
#include "hamilcar/live/socket_page.hpp"

namespace hamilcar::live {

class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
public:
    // A browser that has its page needs a moment to fetch it, and few do so at once.
    static constexpr int max_links = 16, max_downloads = 16;

    HttpConnection(boost::asio::ip::tcp::socket socket, ServerState& state, Access& access, const std::string& page)
        : stream_(std::move(socket)), state_(state), access_(access), page_(page) {
        state.strangers.push_back(this);
        among_strangers_ = std::prev(state.strangers.end());
    }
    ~HttpConnection() { leave_strangers(); }
    HttpConnection(const HttpConnection&) = delete;
    HttpConnection& operator=(const HttpConnection&) = delete;

    void start() {
        constexpr auto header_timeout = std::chrono::seconds(2);
        constexpr std::uint32_t max_header_size = 8192;
        parser_.header_limit(max_header_size);
        stream_.expires_after(header_timeout);
        beast::http::async_read_header(stream_, buffer_, parser_,
                                       [self = shared_from_this()](beast::error_code error, std::size_t) {
                                           if (!error) self->answer();
                                       });
    }

    // Makes room for a newcomer.
    void drop() {
        leave_strangers();
        stream_.close();
    }

private:
    using Response = beast::http::response<beast::http::string_body>;

    void leave_strangers() {
        if (among_strangers_) state_.strangers.erase(*among_strangers_);
        among_strangers_.reset();
    }

    void answer() {
        const int status = access_.judge(request_of(parser_.get()));
        if (status == 101) return open_link();
        if (status != 200) return respond(static_cast<beast::http::status>(status));
        if (state_.downloads >= max_downloads) return respond(beast::http::status::service_unavailable);
        leave_strangers();
        download_.emplace(state_.downloads);
        respond(beast::http::status::ok);
    }

    void open_link() {
        if (state_.links >= max_links) return respond(beast::http::status::service_unavailable);
        leave_strangers();
        stream_.expires_never();  // the link has its own timeouts
        std::make_shared<SocketPage>(std::move(stream_), state_)->accept(parser_.release());
    }

    void respond(beast::http::status status) {
        response_ = Response(status, parser_.get().version());
        using beast::http::field;
        response_.set(field::cache_control, "no-store");
        response_.set("X-Content-Type-Options", "nosniff");
        response_.set("Referrer-Policy", "no-referrer");
        const std::string body = status == beast::http::status::ok ? allowed() : refused(status);
        if (parser_.get().method() != beast::http::verb::head) response_.body() = body;
        response_.content_length(body.size());
        response_.keep_alive(false);
        beast::http::async_write(stream_, response_,
                                 [self = shared_from_this()](beast::error_code, std::size_t) { self->shut_down(); });
    }

    // The entrance or the page.
    std::string allowed() {
        const std::string_view target = view_of(parser_.get().target());
        const bool entrance = Access::is_entrance(target);
        response_.set(beast::http::field::content_type, "text/html; charset=utf-8");
        response_.set("Content-Security-Policy",
                      access_.content_security_policy(entrance ? "" : inline_policy_of(page_)));
        if (!entrance) return page_;
        response_.set(beast::http::field::set_cookie, access_.cookie());
        if (parser_.get().method() != beast::http::verb::head) access_.entered(target);
        return access_.entrance_page();
    }

    std::string refused(beast::http::status status) {
        response_.set(beast::http::field::content_type, "text/plain; charset=utf-8");
        return refusal_text(static_cast<int>(status), view_of(beast::http::obsolete_reason(status)));
    }

    // The client closes first, so that it has received everything.
    void shut_down() {
        beast::error_code ignored;
        stream_.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored);
        stream_.async_read_some(boost::asio::buffer(rest_),
                                [self = shared_from_this()](beast::error_code error, std::size_t) {
                                    if (!error) self->shut_down();
                                });
    }

    beast::tcp_stream stream_;
    ServerState& state_;
    std::optional<std::list<HttpConnection*>::iterator> among_strangers_;
    std::optional<Slot> download_;
    Access& access_;
    const std::string& page_;
    beast::flat_buffer buffer_;
    beast::http::request_parser<beast::http::empty_body> parser_;
    Response response_;
    std::array<char, 1024> rest_{};
};

}  // namespace hamilcar::live
