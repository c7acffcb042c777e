#include <gtest/gtest.h>

#include <QApplication>
#include <QFile>
#include <QFileDialog>
#include <QLineEdit>
#include <QMessageBox>
#include <QPushButton>
#include <QSettings>
#include <QTemporaryDir>
#include <QTimer>

#include "app/gui/dialog_folder.h"

namespace ir::gui {
namespace {

/// Chooses a name in the dialog for files, and answers what is asked then.
class Person : public QObject {
  public:
    Person(const QString& name, QMessageBox::StandardButton answer) : name_(name), answer_(answer) {
        connect(&timer_, &QTimer::timeout, this, &Person::act);
        timer_.start(10);
    }
    bool was_asked() const { return was_asked_; }

  private:
    void act() {
        auto* dialog = QApplication::activeModalWidget();
        if (auto* files = qobject_cast<QFileDialog*>(dialog)) {
            files->findChild<QLineEdit*>("fileNameEdit")->setText(name_);
            static_cast<QDialog*>(files)->accept();
        } else if (auto* question = qobject_cast<QMessageBox*>(dialog)) {
            was_asked_ = true;
            question->button(answer_)->click();
        }
    }
    QString name_;
    QMessageBox::StandardButton answer_;
    QTimer timer_;
    bool was_asked_ = false;
};

class AskForExport : public testing::Test {
  protected:
    AskForExport() { remember_export(at("before.csv")); }
    ~AskForExport() override { QSettings().remove("export/folder"); }
    QString at(const char* name) const { return folder.filePath(QLatin1String(name)); }
    static QString ask() {
        return ask_for_export(nullptr, "Export", "numbers", "Tables (*.csv *.tsv)", {".csv", ".tsv"});
    }
    QTemporaryDir folder;
};

TEST_F(AskForExport, ANameGetsItsEnding) {
    const Person person(at("a"), QMessageBox::Yes);
    EXPECT_EQ(ask(), at("a.csv"));
    EXPECT_FALSE(person.was_asked());
}

TEST_F(AskForExport, AnotherEndingOfTheListStays) {
    const Person person(at("a.TSV"), QMessageBox::Yes);
    EXPECT_EQ(ask(), at("a.TSV"));
}

TEST_F(AskForExport, AFileIsNotReplacedUnasked) {
    QFile there(at("a.csv"));
    ASSERT_TRUE(there.open(QIODevice::WriteOnly));
    for (const char* name : {"a", "a.csv"}) {
        {
            const Person cautious(at(name), QMessageBox::No);
            EXPECT_TRUE(ask().isEmpty()) << name;
            EXPECT_TRUE(cautious.was_asked()) << name;
        }
        const Person sure(at(name), QMessageBox::Yes);
        EXPECT_EQ(ask(), at("a.csv")) << name;
    }
}

}  // namespace
}  // namespace ir::gui
