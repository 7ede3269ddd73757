#define BOOST_ASIO_DISABLE_THREADS  // single-threaded: no locks, and no fences, which ThreadSanitizer does not support

#include "hamilcar/live/server.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>

#include "hamilcar/io/error.hpp"
#include "hamilcar/live/http_connection.hpp"

namespace hamilcar::live {

namespace asio = boost::asio;
using asio::ip::tcp;

namespace {

// Who has shown no secret yet: the oldest gives way to a newcomer, so that waiting here keeps no client out.
constexpr std::size_t max_strangers = 128;
constexpr int send_buffer =
    1 << 17;  // small, so that frames wait in SocketPage, where a newer one replaces them [byte]
constexpr auto tick_interval = std::chrono::milliseconds(50);
constexpr int ticks_per_status = 4, ticks_per_second = 20, ticks_per_line = 1200;
constexpr auto shutdown_timeout = std::chrono::seconds(1);

// A child process, such as the browser, must not inherit the socket: if it outlived the server it would keep the port open.
void close_on_exec(int descriptor) {
    ::fcntl(descriptor, F_SETFD, FD_CLOEXEC);
}

tcp::acceptor listen(asio::io_context& context, std::uint16_t port) {
    try {
        tcp::acceptor acceptor(context, tcp::endpoint(asio::ip::address_v4::loopback(), port));
        close_on_exec(acceptor.native_handle());
        return acceptor;
    } catch (const boost::system::system_error& error) {
        throw io::Error(io::ExitCode::input_output,
                        fmt::format("cannot listen on 127.0.0.1:{}: {}", port, error.code().message()));
    }
}

}  // namespace

class Server::Parts {
public:
    Parts(Session& session, ServerOptions options)
        : options_(std::move(options)),
          connections_(session),
          acceptor_(listen(context_, options_.port)),
          access_(random_secrets(), acceptor_.local_endpoint().port()),
          wake_up_(context_, ::fcntl(session.wake_up().descriptor(), F_DUPFD_CLOEXEC, 0)),
          tick_(context_) {}

    const Access& access() const { return access_; }
    std::uint16_t port() const { return acceptor_.local_endpoint().port(); }

    void run(const std::function<bool()>& stop) {
        accept_next();
        wait_for_wake_up();
        tick_.expires_after(tick_interval);
        tick(stop);
        context_.run();
        context_.restart();
        context_.run_for(shutdown_timeout);
        if (options_.log) options_.log(connections_.summary());
    }

private:
    void accept_next() {
        accepting_ = true;
        acceptor_.async_accept([this](beast::error_code error, tcp::socket socket) {
            accepting_ = false;
            if (error) return drop_oldest_stranger();  // for example too many open files: the next tick tries again
            if (state_.strangers.size() >= max_strangers) drop_oldest_stranger();
            start_connection(std::move(socket));
            accept_next();
        });
    }

    void drop_oldest_stranger() {
        if (!state_.strangers.empty()) state_.strangers.front()->drop();
    }

    void start_connection(tcp::socket socket) {
        close_on_exec(socket.native_handle());
        beast::error_code ignored;
        socket.set_option(tcp::no_delay(true), ignored);
        socket.set_option(asio::socket_base::send_buffer_size(send_buffer), ignored);
        std::make_shared<HttpConnection>(std::move(socket), state_, access_, options_.page)->start();
    }

    void wait_for_wake_up() {
        wake_up_.async_wait(asio::posix::stream_descriptor::wait_read, [this](beast::error_code error) {
            if (error) return;
            connections_.update();
            wait_for_wake_up();
        });
    }

    void tick(const std::function<bool()>& stop) {
        tick_.async_wait([this, &stop](beast::error_code) {
            if (stop()) return shut_down();
            ++ticks_;
            connections_.send_tiles();
            if (ticks_ % ticks_per_status == 0) connections_.send_status();
            if (ticks_ % ticks_per_second == 0) connections_.forgive();
            if (ticks_ % ticks_per_line == 0 && options_.log) options_.log(connections_.summary());
            if (!accepting_) accept_next();
            tick_.expires_after(tick_interval);
            tick(stop);
        });
    }

    void shut_down() {
        beast::error_code ignored;
        acceptor_.close(ignored);
        wake_up_.cancel(ignored);
        for (SocketPage* page : state_.pages) page->shut_down();
        context_.stop();
    }

    ServerOptions options_;
    Connections connections_;
    ServerState state_{connections_};
    asio::io_context context_{1};  // destroyed before `state_`, since it owns all connections
    tcp::acceptor acceptor_;
    Access access_;
    asio::posix::stream_descriptor wake_up_;
    asio::steady_timer tick_;
    bool accepting_ = false;
    long ticks_ = 0;
};

Server::Server(Session& session, ServerOptions options)
    : parts_(std::make_unique<Parts>(session, std::move(options))) {}

Server::~Server() = default;

std::uint16_t Server::port() const {
    return parts_->port();
}

std::string Server::url() const {
    return parts_->access().url();
}

std::string Server::url_once() const {
    return parts_->access().url_once();
}

void Server::run(const std::function<bool()>& stop) {
    parts_->run(stop);
}

}  // namespace hamilcar::live
