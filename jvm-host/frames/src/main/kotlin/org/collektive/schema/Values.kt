package org.collektive.schema

/** The value of a schema's `Vector2`. */
public data class Vector2Value @JvmOverloads constructor(val x: Float = 0f, val y: Float = 0f)

/** The value of a schema's `Vector3`. */
public data class Vector3Value @JvmOverloads constructor(val x: Float = 0f, val y: Float = 0f, val z: Float = 0f)

/** The value of a schema's `Quaternion`. */
public data class QuaternionValue @JvmOverloads constructor(val x: Float = 0f, val y: Float = 0f, val z: Float = 0f, val w: Float = 0f)

/** The value of a schema's `Color`: linear, each channel 0..1. */
public data class ColorValue @JvmOverloads constructor(val r: Float = 0f, val g: Float = 0f, val b: Float = 0f, val a: Float = 0f)
