// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "film/image.h"

namespace brume {

/// What pictures are measured against. Its own noise must not count as their error, and does not:
/// of two independent pictures the products of the differences from one and from the other have
/// the right expectation; of one picture the known variance is taken off.
struct Reference {
  Image first;
  Image second;           // independent of `first`, or the same
  Image variance{};       // of both when they are the same; no pixels: 0
  double radiance = 0.0;  // mean over pixels and channels
};

/// Two independent renders of the same picture.
Reference reference_of_halves(Image first, Image second);
/// A finished picture: one with error layers, or else one taken for exact.
Reference reference_of_picture(const Image& picture);
/// The mean of both.
Image best_picture(const Reference& reference);

/// An estimate and the half width of its 95% confidence interval.
struct Estimate {
  double value = 0.0;
  double error = 0.0;
};

/// How far pictures of one setting are from the reference, whose mean radiance is the unit. The
/// estimates are unbiased, so that one of a small square may be negative.
struct Accuracy {
  Estimate squared_error;  // of one picture, mean over pixels and channels
  Estimate squared_bias;   // the part of it that more samples do not remove
  double variance = 0.0;   // the rest
  Estimate mean_bias;      // of the mean radiance: negative is too dark
};

/// `pictures` are independent renders, two at least, of the size of `reference`. Intervals come
/// from the spread over pixels, which are independent.
Accuracy measure_accuracy(std::span<const Image> pictures, const Reference& reference);

/// Square root of an estimate of a square, and its interval. Below, where the square is negative,
/// there is nothing: the interval begins at 0.
struct RootInterval {
  double value, low, high;
};
RootInterval root(const Estimate& square);

}  // namespace brume
