// diff_cases FOLDER SKYLAPSE: writes pairs of pictures that a comparison must tell apart, and pairs
// that it must not, with their list. benchmarks/diff/cases.py runs comparisons over them.
#include <cstdio>
#include <exception>

#include "diff_cases/case_list.h"

int main(int argc, char** argv) {
  using namespace skylapse::diff_cases;
  if (argc != 3) {
    std::fprintf(stderr, "usage: diff_cases FOLDER SKYLAPSE\n");
    return 3;
  }
  try {
    CaseList list(argv[1]);
    add_plain_sabotages(list);
    add_plain_innocents(list);
    render_frames(list, argv[2]);
    add_damages(list);
    add_renders(list, argv[2]);
    add_time_lapses(list);
    add_more_innocents(list);
    add_bad_files(list);
    list.write_list();
    std::printf("%zu cases in %s\n", list.cases().size(), argv[1]);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "diff_cases: %s\n", e.what());
    return 6;
  }
  return 0;
}
