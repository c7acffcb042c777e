// Names, titles and kept pictures while the method changes.
#include <QComboBox>
#include <QDockWidget>
#include <QTemporaryDir>

#include "renderers/image/exr.h"
#include "tests/gui/window/window_fixture.h"
#include "widgets/document/experiment_panel.h"

namespace ir::gui {
namespace {

using widgets::ResultsModel;

class NamesWindowTest : public WindowTest {
  protected:
    void SetUp() override {
        WindowTest::SetUp();
        open_scene();
    }
    QComboBox* list(const char* name) {
        return window.findChild<widgets::ExperimentPanel*>()->findChild<QComboBox*>(name);
    }
    void choose_method(const QString& title) { choose(list("method"), title); }
    QString experiment_shown() { return list("experiment")->currentText(); }
    std::shared_ptr<const widgets::Picture> picture() {
        return window.views().pictures().picture(window.views().active_state().a);
    }
    ResultsModel& results() { return window.results().panel().model(); }

    /// Keeps the picture that is shown, as the render thread would.
    void keep() {
        if (window.session().open_project().folder().empty())
            window.session().files().save_as((folder.path() + "/kept.interreflect").toStdString());
        renderer.on_keep = [](const engine::KeepRequest& request) {
            const auto& kept = *projects::find_item(request.project.experiments, request.experiment);
            projects::KeptResult result;
            result.key = projects::result_key(request.project, kept, fake_registry());
            result.inputs = projects::picture_inputs(request.project, kept, fake_registry());
            result.experiment = kept.id;
            const auto name = projects::result_folder(result.key);
            const auto results = std::filesystem::path(request.folder) / "results";
            std::filesystem::create_directories(results / name);
            write_exr(results / name / "main.exr", {{"", {"R", "G", "B"}, Image(4, 4, 3, 0.5f)}}, {});
            result.files.push_back({projects::main_role, name + "/main.exr", "", {}});
            auto index = projects::ResultIndex::load(request.folder);
            index.put(result);
            index.save(request.folder);
            return engine::KeepResult{request.tag, request.experiment, result.key, ""};
        };
        auto* dock = window.findChild<QDockWidget*>("results");
        dock->show();
        dock->raise();
        const int before = results().rowCount();
        trigger("keep");
        ASSERT_TRUE(QTest::qWaitFor([&] { return results().rowCount() > before; }, 60000));
    }
    QString cell(int column) { return results().index(0, column).data().toString(); }
    std::string kept_name() {
        return window.views().pictures().owner_name("result:" + results().rows()[0].key.toStdString());
    }

    QTemporaryDir folder;
};

TEST_F(NamesWindowTest, TheMethodsTitleIsEverywhereAndOneUndoBringsTheOldOneBack) {
    choose_method("Fake method");
    type_level("0.75");
    EXPECT_EQ(experiment_shown(), "Fake method");
    choose_method("Fake truth");
    EXPECT_EQ(experiment_shown(), "Fake truth");
    EXPECT_TRUE(picture()->label.startsWith("Fake truth · ")) << picture()->label.toStdString();
    EXPECT_EQ(pixel(), 0.25f) << "an equal key carries nothing over";
    trigger("undo");
    EXPECT_EQ(experiment_shown(), "Fake method");
    EXPECT_EQ(pixel(), 0.75f);
    trigger("experiment-add");
    EXPECT_EQ(experiment_shown(), "Fake method 2");
}

TEST_F(NamesWindowTest, ANameThatAPersonGaveStays) {
    const auto id = window.session().experiment()->id;
    window.session().edit([&](const projects::Project& project) {
        return projects::edits::rename<projects::Experiment>(project, id, "Nave");
    });
    choose_method("Fake truth");
    EXPECT_EQ(experiment_shown(), "Nave");
}

TEST_F(NamesWindowTest, NoPictureOfTheOldMethodStandsUnderTheNewName) {
    choose_method("Fake method");
    ASSERT_TRUE(picture()->has_image());
    renderer.hold = true;
    auto* methods = list("method");
    emit methods->activated(methods->findText("Fake truth"));
    EXPECT_EQ(experiment_shown(), "Fake truth");
    EXPECT_FALSE(picture()->has_image());
    const auto first = renderer.requests.front(), last = renderer.requests.back();
    renderer.answer(first, 1);  // the old method was not finished yet
    EXPECT_FALSE(picture()->has_image());
    renderer.answer(last, renderer.requests.size());
    EXPECT_TRUE(picture()->has_image());
}

TEST_F(NamesWindowTest, KeptPicturesAreCalledAfterWhatRenderedThem) {
    choose_method("Fake method");
    keep();
    EXPECT_TRUE(kept_name().starts_with("Fake method")) << kept_name();
    choose_method("Fake truth");
    EXPECT_TRUE(kept_name().starts_with("Fake method")) << kept_name();
    EXPECT_EQ(cell(ResultsModel::experiment_column), "Fake truth");
    EXPECT_EQ(cell(ResultsModel::method_column), "Fake method");
    const auto id = window.session().experiment()->id;
    window.session().edit([&](const projects::Project& project) {
        return projects::edits::rename<projects::Experiment>(project, id, "Nave");
    });
    EXPECT_TRUE(kept_name().starts_with("Nave (Fake method)")) << kept_name();
    choose_method("Fake method");
    EXPECT_TRUE(kept_name().starts_with("Nave")) << kept_name();
    EXPECT_EQ(kept_name().find("Fake"), std::string::npos) << kept_name();
}

}  // namespace
}  // namespace ir::gui
