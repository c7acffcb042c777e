#include "app/gui/run.h"

int main(int argc, char** argv) {
    return ir::gui::run(argc, argv);
}
