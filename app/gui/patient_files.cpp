#include "app/gui/patient_files.h"

#include <QCoreApplication>
#include <QEventLoop>
#include <QGuiApplication>
#include <QThread>
#include <QTimer>
#include <chrono>
#include <future>

namespace ir::gui {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds unnoticed{100};  ///< a wait that nobody feels
constexpr int look_ms = 5;

bool is_window_thread() {
    return QCoreApplication::instance() && QThread::currentThread() == QCoreApplication::instance()->thread();
}

template <class Result>
bool is_ready(const std::future<Result>& result, std::chrono::milliseconds within = {}) {
    return result.wait_for(within) == std::future_status::ready;
}

}  // namespace

template <class Work>
auto PatientFiles::patiently(const Work& work) {
    if (!is_window_thread() || silences_ > 0) return work();
    auto result = std::async(std::launch::async, work);
    if (!is_ready(result, unnoticed)) {
        ++waiting_;
        QGuiApplication::setOverrideCursor(Qt::BusyCursor);
        QEventLoop meanwhile;
        QTimer look;
        QObject::connect(&look, &QTimer::timeout, &meanwhile, [&] {
            if (is_ready(result)) meanwhile.quit();
        });
        look.start(look_ms);
        meanwhile.exec(QEventLoop::ExcludeUserInputEvents);
        result.wait();  // the program may have been told to end
        QGuiApplication::restoreOverrideCursor();
        --waiting_;
    }
    return result.get();
}

PatientFiles& patient_files() {
    static PatientFiles files;
    return files;
}

PatientFiles::Silence::Silence() {
    ++patient_files().silences_;
}

PatientFiles::Silence::~Silence() {
    --patient_files().silences_;
}

void PatientFiles::wait_for(const std::function<void()>& work) {
    patiently(work);
}

bool PatientFiles::exists(const fs::path& path) {
    return patiently([&] { return real_file_system().exists(path); });
}

std::string PatientFiles::read(const fs::path& file, std::size_t limit) {
    return patiently([&] { return real_file_system().read(file, limit); });
}

void PatientFiles::write(const fs::path& temporary, const fs::path& target, const Fill& fill) {
    patiently([&] { real_file_system().write(temporary, target, fill); });
}

void PatientFiles::sync_directory(const fs::path& folder) {
    patiently([&] { real_file_system().sync_directory(folder); });
}

void PatientFiles::rename(const fs::path& from, const fs::path& to) {
    patiently([&] { real_file_system().rename(from, to); });
}

void PatientFiles::remove(const fs::path& file) {
    patiently([&] { real_file_system().remove(file); });
}

void PatientFiles::create_directories(const fs::path& folder) {
    patiently([&] { real_file_system().create_directories(folder); });
}

void PatientFiles::pour(const fs::path& file, std::ostream& out) {
    patiently([&] { real_file_system().pour(file, out); });
}

std::vector<fs::path> PatientFiles::list(const fs::path& folder) {
    return patiently([&] { return real_file_system().list(folder); });
}

void PatientFiles::remove_all(const fs::path& folder) {
    patiently([&] { real_file_system().remove_all(folder); });
}

std::int64_t PatientFiles::modified(const fs::path& file) {
    return patiently([&] { return real_file_system().modified(file); });
}

}  // namespace ir::gui
