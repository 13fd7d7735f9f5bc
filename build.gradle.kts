// build/ belongs to ./collektive: Gradle's reports about the whole build go beside the modules.
layout.buildDirectory = layout.projectDirectory.dir("jvm-host/build")
