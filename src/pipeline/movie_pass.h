#pragma once
// Movies, once their frames are there.
#include <string>
#include <vector>

#include "core/result.h"
#include "pipeline/job_context.h"

namespace skylapse::pipeline {

/// One movie file: the frames whose expanded name it is, in the plan's order.
struct Movie {
  size_t output = 0;
  std::string path;
  std::vector<long> frames;
};
std::vector<Movie> movies_of(const plan::Plan& plan);

/// Its settings and the fingerprints of its frames' pictures.
std::string fingerprint_of(const JobContext& job, const Movie& movie);

/// If the plan has movies: ffmpeg must be there before anything is rendered, and all frames of one
/// movie must have one size.
Status check_movies_possible(const plan::Plan& plan);

/// Makes each movie that is not finished yet. Frames are read back from a lossless 8-bit output
/// with the same view if the job has one, else rendered again. With frames of other shards still
/// missing, or when only some frames were asked for, movies are left out with a note.
Status make_movies(const JobContext& job, RunSummary& summary);

}  // namespace skylapse::pipeline
