// Keys of place and time. The rows are explained in key_spec.h.
#include "config/key_sections.h"
#include "config/words.h"

namespace skylapse::config {
namespace {

using K = ValueKind;
using D = Dimension;

const SectionSpec& date_range_spec() {
  static const SectionSpec spec{
      .name = "dates",
      .doc = "A range of days.",
      .keys = {
          {.name = "from",
           .kind = K::date,
           .required = true,
           .example = "2026-06-01",
           .doc = "First day."},
          {.name = "to",
           .kind = K::date,
           .required = true,
           .example = "2026-06-30",
           .doc = "Last day, included if the steps reach it."},
          {.name = "step",
           .kind = K::quantity,
           .dimension = D::days,
           .min = "1 day",
           .max = "3660 days",
           .default_text = "1 day",
           .example = "7 days",
           .doc = "From one day of the range to the next, in whole days."},
      }};
  return spec;
}

}  // namespace

const SectionSpec& site_spec() {
  static const SectionSpec spec{
      .name = "location",
      .doc =
          "A place on the Earth. `locations` is a list of such sections; the job renders every "
          "one of them.",
      .keys = {
          {.name = "name",
           .kind = K::text,
           .default_text = "site1, site2, ...",
           .example = "Prague",
           .doc = "Name of the place, used in messages and by the token {site} of output names."},
          {.name = "latitude",
           .kind = K::quantity,
           .dimension = D::latitude,
           .min = "-90 deg",
           .max = "90 deg",
           .required = true,
           .example = "50.0755 deg",
           .doc = "Geodetic latitude (WGS84), north positive. A plain number is in degrees; "
                  "50°04'32\"N is understood too."},
          {.name = "longitude",
           .kind = K::quantity,
           .dimension = D::longitude,
           .min = "-180 deg",
           .max = "360 deg",
           .required = true,
           .example = "14.4378 deg",
           .doc = "Longitude, east positive. A plain number is in degrees."},
          {.name = "height",
           .kind = K::quantity,
           .dimension = D::length,
           .min = "-500 m",
           .max = "400000 km",
           .default_text = "0 m",
           .example = "235 m",
           .doc =
               "Height above the WGS84 ellipsoid, from the ground to beyond the moon's distance."},
          {.name = "zone",
           .kind = K::zone,
           .example = "Europe/Prague",
           .doc = "Time zone of this place. Wins over `time.zone`."},
      }};
  return spec;
}

const SectionSpec& time_spec() {
  static const SectionSpec spec{
      .name = "time",
      .doc = "Which moments are rendered. Days and locations multiply with them.",
      .keys =
          {
              {.name = "zone",
               .kind = K::zone,
               .example = "Europe/Prague",
               .doc = "Time zone of all clock times and calendar days: an IANA name, UTC, or an "
                      "offset "
                      "such as +02:00. Needed unless every time carries its own offset."},
              {.name = "date",
               .kind = K::date,
               .example = "2026-06-21",
               .doc = "The day, for times that do not carry a day of their own."},
              {.name = "dates",
               .kind = K::dates,
               .sections = {&date_range_spec()},
               .example = "2026-06-01 .. 2026-06-30",
               .doc = "Several days: a range \"first .. last\", a section {from, to, step}, or a "
                      "list. "
                      "A day that the zone skips is passed over within a range."},
              {.name = "from",
               .kind = K::time,
               .default_text = "00:00",
               .example = "sunrise - 45 min",
               .doc = "Where the frames of a day begin."},
              {.name = "to",
               .kind = K::time,
               .default_text = "24:00",
               .example = "sunset + 45 min",
               .doc = "Where the frames of a day end."},
              {.name = "step",
               .kind = K::quantity,
               .dimension = D::duration,
               .min = "1 ms",
               .max = "366 day",
               .example = "2 min",
               .doc = "Time from one frame to the next."},
              {.name = "frames",
               .kind = K::integer,
               .min = "1",
               .max = "1000000",
               .example = "240",
               .doc = "Number of frames, evenly from `from` to `to`, both included."},
              {.name = "every",
               .kind = K::quantity,
               .dimension = D::angle,
               .min = "0.01 deg",
               .max = "90 deg",
               .example = "1 deg",
               .doc = "A frame whenever the sun's true elevation passes a multiple of this angle."},
              {.name = "at",
               .kind = K::time,
               .list = true,
               .example = "[sunrise, solar_noon, 18:30]",
               .doc = "The times themselves."},
              {.name = "sun_elevations",
               .kind = K::quantity,
               .dimension = D::angle,
               .min = "-90 deg",
               .max = "90 deg",
               .list = true,
               .example = "[-4 deg, 0 deg, 5 deg, 30 deg]",
               .doc = "A frame whenever the true elevation of the sun's centre is one of these, in "
                      "the order written. Days on which the sun does not stand there are noted and "
                      "passed over."},
              {.name = "half",
               .kind = K::word,
               .words = words_of(kHalfWords),
               .default_text = "both",
               .example = "morning",
               .doc =
                   "For sun_elevations: while the sun rises, while it sinks, or both. Names hold "
                   "it by the token {half}."},
              {.name = "dut1",
               .kind = K::quantity,
               .dimension = D::duration,
               .min = "-0.9 s",
               .max = "0.9 s",
               .default_text = "0 s",
               .example = "0.12 s",
               .doc = "UT1 - UTC, from IERS Bulletin A. Without it the sun is off by up to 13.5 "
                      "arcsec."},
          },
      .alternatives = {{{"date", "dates"}},
                       {{"step", "frames", "every", "at", "sun_elevations"}, true}}};
  return spec;
}

}  // namespace skylapse::config
