package org.collektive.frames.data

/** Reads the binary form of [schema] from the folder of its generated code. */
internal fun binarySchema(schema: DataSchema): ByteArray =
    checkNotNull(schema.javaClass.getResourceAsStream("/${ReflectionReader.entry(schema.name)}")).use { it.readAllBytes() }

internal fun reflectionReader(schema: DataSchema): ReflectionReader = ReflectionReader(binarySchema(schema))
