// SPDX-License-Identifier: Apache-2.0
// Furniture from a handful of dimensions, as a tape measure gives them. Each kind is a plain struct (numbers, choices, and colours as
// 0xRRGGBB) with a validate(), and a function that makes its articulated model of closed shapes.
//
// Model frame: z up, x out of the front, the origin on the floor below the middle of the footprint; "left" and "right" are those of a
// person who stands before it, so left is -y. Part 0 is "body", its frame the model's. The frame of a part that moves stands upright on
// its joint's origin; joints are at 0 when closed, and their values grow up to `upper` on opening. A handle's frame lies in the middle of
// its grip, x away from the face and z along the grip. Each material has a name to hang a texture on ("body", "front", "handle", …);
// texture coordinates are metres along the faces.
#pragma once

#include "core/model/furniture/appliances.h"
#include "core/model/furniture/cabinet.h"
#include "core/model/furniture/living.h"
#include "core/model/furniture/room_door.h"
#include "core/model/furniture/sanitary.h"
