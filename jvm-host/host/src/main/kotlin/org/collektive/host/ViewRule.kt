package org.collektive.host

import com.google.flatbuffers.BaseVector
import com.google.flatbuffers.Struct
import com.google.flatbuffers.Table
import org.collektive.runtime.SharingRule
import java.nio.ByteBuffer

/** Keeps views of a tick's pooled memory inside their round. */
internal object ViewRule : SharingRule {
    override fun refusal(value: Any?): String? =
        if (value is Table || value is Struct || value is BaseVector || value is ByteBuffer) {
            "a ${value.javaClass.name} is a view of this tick's memory and is valid in this round only: " +
                "take the values out of it (a number, a data class, an array)"
        } else {
            null
        }
}
