// diff_cases FOLDER SKYLAPSE [few]: writes pairs of pictures that a comparison must tell apart, and
// pairs that it must not, with their list. `few` are those of every run of the tests.
// benchmarks/diff/cases.py runs comparisons over them.
#include <cstdio>
#include <exception>
#include <string>

#include "diff_cases/case_list.h"

int main(int argc, char** argv) {
  using namespace skylapse::diff_cases;
  if (argc < 3 || argc > 4 || (argc == 4 && argv[3] != std::string("few"))) {
    std::fprintf(stderr, "usage: diff_cases FOLDER SKYLAPSE [few]\n");
    return 3;
  }
  const bool all = argc == 3;
  try {
    CaseList list(argv[1]);
    add_plain_sabotages(list);
    add_plain_innocents(list);
    render_frames(list, argv[2]);
    add_time_lapses(list);
    add_bad_files(list);
    if (all) {
      add_damages(list);
      add_more_innocents(list);
      add_renders(list, argv[2]);
      add_file_kinds(list, argv[2]);
    }
    list.write_list();
    std::printf("%zu cases in %s\n", list.cases().size(), argv[1]);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "diff_cases: %s\n", e.what());
    return 6;
  }
  return 0;
}
