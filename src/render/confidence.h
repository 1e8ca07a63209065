// Quantiles for confidence intervals.
#pragma once

namespace strata::render {

// The z that a standard normal number stays below with probability p, p in (0,1). Error <= 1e-12.
double normal_quantile(double p);

// The t that a number of Student's distribution of `dof` >= 1 degrees of freedom stays below with probability p, p in
// (0,1). Relative error <= 1e-9. The distribution function in closed form: Abramowitz & Stegun 26.7.3 and 26.7.4.
double student_quantile(double p, int dof);

}  // namespace strata::render
