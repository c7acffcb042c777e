#pragma once

#include <QApplication>
#include <QTemporaryDir>
#include <QToolButton>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "app/engine/sweep_job.h"
#include "projects/results.h"
#include "projects/scene_files.h"
#include "projects/sweep.h"
#include "renderers/core/error.h"
#include "renderers/core/write_file.h"
#include "renderers/image/exr.h"
#include "tests/gui/window/window_fixture.h"
#include "widgets/panels/empty_tree_view.h"

namespace ir::gui {

/// Renders as many variations as are let through: pictures of their level, whose error is the smaller the
/// higher it is. Like the real one it goes on with what is there.
struct FakeSweeps {
    std::atomic<int> allowed{1000}, runs{0}, rendered{0};

    void run(const engine::SweepRequest& request, const engine::SweepCallbacks& told) {
        ++runs;
        const auto& job = request.job;
        std::filesystem::create_directories(job.out / engine::references_folder);
        const auto points = projects::sweep_points(job.project, job.sweep, fake_registry());
        engine::SweepTable table{job.sweep.id, job.sweep.experiment, "plan"};
        for (const auto& point : points) table.rows.push_back(planned(job, point));
        const auto resumed = engine::resume_rows(table, job.out, job.repeats > 0, true);
        told.planned(table, resumed);
        const auto write = [&] { write_file(job.list(), engine::table_json(table)); };
        try {
            for (std::size_t i = 0; i < points.size(); ++i) {
                if (table.rows[i].is_done()) continue;
                told.begun(i, points[i]);
                while (rendered >= allowed) {
                    told.frame.progress("counting beads", 0.5);
                    told.frame.cancel->check();
                    std::this_thread::sleep_for(std::chrono::milliseconds(5));
                }
                render(job, table.rows[i]);
                told.ended(i, table.rows[i], false);
                ++rendered;
            }
        } catch (const Cancelled&) {
            write();
            throw;
        }
        write();
    }

    static engine::SweepRow planned(const engine::SweepJob& job, const projects::SweepPoint& point) {
        engine::SweepRow row;
        row.id = point.experiment.id;
        row.coordinates = point.coordinates;
        const auto now =
            projects::with_contents(job.project, projects::read_contents(job.project, job.folder));
        row.key = projects::result_key(now, point.experiment, fake_registry());
        if (job.is_judged) row.reference = "truth";
        return row;
    }
    static void render(const engine::SweepJob& job, engine::SweepRow& row) {
        const double level = row.coordinates.value("level", 1.0);
        if (level > 8) {
            row.problem = "out of beads";
            return;
        }
        row.problem.clear();
        row.cold_ms = 10 * level;
        row.memory_bytes = 1 << 20;
        row.device = "abacus";
        row.build = "fake";
        row.image = row.id + ".exr";
        write(job.out / row.image, float(level));
        if (!job.is_judged) return;
        row.warm_ms = 5 * level;
        row.errors["rmse"] = 1 / level;
        row.pixels = 48;
        write(job.out / engine::references_folder / "truth.exr", 1);
    }
    static void write(const std::filesystem::path& file, float value) {
        Image image(8, 6, 3);
        for (auto& each : image.pixels) each = value;
        write_exr(file, {{"", standard_channels(3), image}}, {});
    }
};

class SweepsWindowTest : public WindowTest {
  protected:
    void SetUp() override {
        on_sweep = [this](const auto& request, const auto& told) { fake.run(request, told); };
        WindowTest::SetUp();
        open_scene();
        window.docks().apply("sweeps");
        ASSERT_TRUE(settle());
    }
    void TearDown() override {
        fake.allowed = 1 << 20;
        WindowTest::TearDown();
    }
    SweepsDock& dock() { return *window.findChild<SweepsDock*>(); }
    widgets::SweepPanel& panel() { return dock().panel(); }
    widgets::ContactSheet& sheet() { return panel().sheet(); }
    template <class Widget>
    Widget* find(const char* name) {
        return panel().findChild<Widget*>(QLatin1String(name));
    }
    void press(const char* name) { QTest::mouseClick(find<QToolButton>(name), Qt::LeftButton); }
    const projects::Sweep& sweep() { return window.session().document().sweeps.front(); }
    /// Of the chosen experiment over its level and seed.
    void add_sweep(std::vector<projects::Json> levels = {4, 2, 1},
                   std::vector<projects::Json> seeds = {1, 2}) {
        dock().add_sweep();
        window.session().edit([&](const projects::Project& p) {
            auto changed = p.sweeps.front();
            changed.axes = {{"level", levels}, {"seed", seeds}};
            return projects::edits::change(p, changed);
        });
        ASSERT_TRUE(settle());
        window.docks().raise("sweeps");
    }
    void save() {
        window.session().files().save_as(project_file());
        ASSERT_TRUE(settle());
    }
    std::string project_file() { return folder.path().toStdString() + "/swept.interreflect"; }
    bool finish() {
        return QTest::qWaitFor([&] { return dock().is_settled(); }, 60000);
    }
    void run_to_end() {
        press("run");
        ASSERT_TRUE(finish());
    }
    QString cell(int row, int column) {
        return panel().table().model()->index(row, column).data().toString();
    }
    int column(const QString& heading) { return 1 + int(panel().model().rows().headings.indexOf(heading)); }
    /// Clicks a variation in the sheet, in the order shown.
    void click_cell(int row, Qt::KeyboardModifiers modifiers = {}) {
        const auto index = sheet().model()->index(row, 0);
        sheet().scrollTo(index);
        QApplication::processEvents();
        QTest::mouseClick(sheet().viewport(), Qt::LeftButton, modifiers, sheet().boxes(index).first.center());
        ASSERT_TRUE(settle());
    }
    double level_now() { return std::get<double>(window.session().experiment()->values.at("level")); }
    int count_done() {
        int done = 0;
        for (const auto& line : panel().model().rows().lines)
            done += line.state == widgets::SweepLine::State::done ? 1 : 0;
        return done;
    }

    QTemporaryDir folder;
    FakeSweeps fake;
};

}  // namespace ir::gui
