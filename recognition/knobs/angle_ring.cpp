// SPDX-License-Identifier: Apache-2.0
#include "recognition/knobs/angle_ring.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "recognition/knobs/ring_images.h"

namespace oikos::recognition {

namespace {

constexpr double kWeakest = 2e-3;  // of a basis's strongest direction, in energy: what is weaker is noise

/// How much the pixels of the support count: what is printed on the carrier is not known.
Eigen::VectorXf weigh(const cv::Mat& carrier, const std::vector<int>& support, float carrier_weight) {
  Eigen::VectorXf weights(static_cast<Eigen::Index>(support.size()));
  for (std::size_t k = 0; k < support.size(); ++k) {
    const float share = carrier.ptr<float>()[support[k]];
    weights[static_cast<Eigen::Index>(k)] = 1.0F - share + carrier_weight * share;
  }
  return weights / std::exp(weights.array().log().mean());
}

/// An orthonormal basis of what the images span on the support, weighted; a row a vector, times the weights' roots.
Eigen::MatrixXf orthonormal(const std::vector<cv::Mat>& images, const std::vector<int>& support, const Eigen::VectorXf& weights) {
  const Eigen::VectorXf roots = weights.cwiseSqrt();
  const Eigen::VectorXf constant = roots.normalized();
  Eigen::MatrixXf columns(static_cast<Eigen::Index>(support.size()), static_cast<Eigen::Index>(images.size()));
  for (std::size_t i = 0; i < images.size(); ++i) {
    for (std::size_t k = 0; k < support.size(); ++k) {
      columns(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i)) = images[i].ptr<float>()[support[k]];
    }
  }
  columns = roots.asDiagonal() * columns;
  columns -= constant * (constant.transpose() * columns).eval();
  const Eigen::MatrixXd gram = (columns.transpose() * columns).cast<double>();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram);
  const Eigen::VectorXd& energies = solver.eigenvalues();
  const double least = kWeakest * energies.maxCoeff();
  const auto kept = std::max<Eigen::Index>(1, (energies.array() > least).count());
  const Eigen::VectorXf scale = energies.tail(kept).cwiseMax(1e-12).cwiseSqrt().cwiseInverse().cast<float>();
  Eigen::MatrixXf basis(kept + 1, columns.rows());
  basis.row(0) = constant.transpose();
  basis.bottomRows(kept) = scale.asDiagonal() * (columns * solver.eigenvectors().rightCols(kept).cast<float>()).transpose();
  return basis * roots.asDiagonal();
}

}  // namespace

AngleRing::AngleRing(const KnobDescription& knob, const KnobFace& face, double tilt_rad, const RingShape& shape) : shape_(shape) {
  const RingWindow window = windowOf(face, tilt_rad, shape);
  build(window, renderImages(knob, face, window, shape.angles));
}

AngleRing::AngleRing(const FacePhoto& photo, const KnobFace& face, double tilt_rad, const RingShape& shape) : shape_(shape) {
  const RingWindow window = windowOf(face, tilt_rad, shape);
  build(window, photoImages(photo, face, window, shape.angles));
}

void AngleRing::build(const RingWindow& window, const std::vector<TemplateImages>& templates) {
  columns_ = window.columns;
  rows_ = window.rows;
  origin_column_ = window.origin_column;
  origin_row_ = window.origin_row;
  cv::Mat covered = cv::Mat::zeros(rows_, columns_, CV_32FC1);
  for (const TemplateImages& one : templates) {
    covered = cv::max(covered, one.covered);
  }
  cv::Mat wide;
  cv::dilate(covered, wide, cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(3, 3)));
  for (int i = 0; i < rows_ * columns_; ++i) {
    if (wide.ptr<float>()[i] > 0.5F) {
      support_.push_back(i);
    }
  }
  std::vector<Eigen::MatrixXf> bases;
  first_row_.push_back(0);
  weights_.resize(static_cast<Eigen::Index>(templates.size()), static_cast<Eigen::Index>(support_.size()));
  for (const TemplateImages& one : templates) {
    const Eigen::VectorXf weights = weigh(one.images.back(), support_, shape_.carrier_weight);
    weights_.row(static_cast<Eigen::Index>(bases.size())) = weights.transpose();
    bases.push_back(orthonormal(one.images, support_, weights));
    first_row_.push_back(first_row_.back() + static_cast<int>(bases.back().rows()));
  }
  bases_.resize(first_row_.back(), static_cast<Eigen::Index>(support_.size()));
  for (std::size_t i = 0; i < bases.size(); ++i) {
    bases_.middleRows(first_row_[i], bases[i].rows()) = bases[i];
  }
}

}  // namespace oikos::recognition
