// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <openvino/openvino.hpp>
#include <openvino/opsets/opset13.hpp>
#include <vector>

namespace {

// The feature networks run on OpenVINO's C++ API from the Python wheel: this shows that it links
// and infers.
TEST(OpenVino, RunsANetworkOnTheProcessor) {
  const auto input = std::make_shared<ov::opset13::Parameter>(ov::element::f32, ov::Shape{1, 4});
  const auto output = std::make_shared<ov::opset13::Relu>(input);
  const auto model =
      std::make_shared<ov::Model>(ov::OutputVector{output}, ov::ParameterVector{input});
  ov::Core core;
  ov::InferRequest request = core.compile_model(model, "CPU").create_infer_request();
  std::vector<float> values = {-1.0F, 2.0F, -3.0F, 4.0F};
  request.set_input_tensor(ov::Tensor(ov::element::f32, {1, 4}, values.data()));
  request.infer();
  const float* result = request.get_output_tensor().data<float>();
  EXPECT_EQ(std::vector<float>(result, result + 4), (std::vector<float>{0.0F, 2.0F, 0.0F, 4.0F}));
}

}  // namespace
