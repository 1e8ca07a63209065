// One place at several sizes of the frame: that a large picture, made smaller, is the small one.
//
// The B-spline of order m over a pixel of k fine ones is a sum of B-splines over these: each is m boxes convolved, and
// a wide box is k narrow ones. So the fine pixels around a coarse one, weighted by (1,...,1) convolved m times with
// itself over k^m, estimate the very integral that the coarse pixel does. What differs is the sampling error of both,
// which renders with other seeds tell, and what the tolerance of hits, in pixels, leaves.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/film/film.h"
#include "src/image/canvas.h"
#include "src/image/picture.h"
#include "src/parallel/cancel.h"
#include "src/scene/scene.h"
#include "tools/job/batch.h"

namespace strata::tools::gallery {

// The fine pixels that coarse ones are made of: those below them and (m-1)(k-1)/2 on each side. An even k needs an odd
// m: else no fine pixel's centre lies where a narrow B-spline's must.
film::Rect fine_window(const film::Rect& coarse, int k, int m);

// The coarse pixels from fine_window()'s.
image::Picture reduced(const image::Picture& fine, const film::Rect& coarse, int k, int m);

struct Scale {
    int factor = 1;
    int width = 0, height = 0;  // of the frame
    image::Picture picture;     // the place in it, without the margin
    image::Picture small;       // the same as coarse pixels, mean of two seeds
    double noise = 0;           // sampling error of `small`, root mean square
    double difference = 0;      // of `small` from that of the first scale, root mean square
    double expected = 0;        // by the sampling errors of both alone
};

// The scene with the stratified estimator, whose samples weigh the same, and order m = 3 or its own odd one; N falls
// with the factor, 1 at least. Nothing if it was stopped.
std::vector<Scale> compare_scales(const scene::Scene& scene, const film::Rect& place, const std::vector<int>& factors,
                                  job::Batch& batch);

// Whether one thread renders the same bits of that scale as the batch did. Nothing if it was stopped.
std::optional<bool> is_same_by_one_thread(const scene::Scene& scene, const film::Rect& place, const Scale& scale,
                                          bool quiet, const parallel::CancelToken& cancel);

// The place at each size, and each as pixels of the first.
image::Canvas draw_scales(const std::vector<Scale>& scales, const scene::Scene& scene, const std::string& caption);

}  // namespace strata::tools::gallery
