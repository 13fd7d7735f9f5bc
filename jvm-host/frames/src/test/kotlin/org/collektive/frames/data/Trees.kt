package org.collektive.frames.data

/** The binary form of [schema], from beside its code. */
internal fun binarySchema(schema: DataSchema): ByteArray =
    checkNotNull(schema.javaClass.getResourceAsStream("/${DataTrees.entry(schema.name)}")).use { it.readAllBytes() }

internal fun trees(schema: DataSchema): DataTrees = DataTrees(binarySchema(schema))
